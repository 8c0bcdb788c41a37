/* ---- 5 structure: which response sections 2 and 3 show; shapes; contacts ----------------------------------------- */

const chosenSolution = () => data.structure.solutions[+$('solution').value];
const chosenResponse = () => (data.structure ? +$('of-response').value : 0);
const shapeWords = {amplitude: 'amplitude', cosine: 'cosine of harmonic 1', sine: 'sine of harmonic 1'};
const shapeShown = () => ($('shape').value === 'phases' ? ['cosine', 'sine'] : ['amplitude']);
const solutionWords = s =>
  where(s.omega) + ', branch ' + s.branch + (s.stable > 0 ? '' : s.stable < 0 ? ', unstable' : ', stability unknown');

function shapeSets() {
  const s = chosenSolution();
  return shapeShown().map((q, i) => ({
    label: shapeWords[q],
    data: s[q].map((y, x) => ({x, y})),
    backgroundColor: colour(i),
    barPercentage: 0.9,
    categoryPercentage: 0.8
  }));
}

/* A loop runs once; all contacts of one kind, or one alone. */
function loopSets() {
  const chosen = $('contact').value;
  const all = chosenSolution().loops;
  const kind = chosen === 'all' ? all[0].of : all[+chosen].of;
  const sets = all.map((loop, j) => {
    const points = loop.x.map((x, i) => ({x, y: loop.y[i], contact: j}));
    return Object.assign(line(data.structure.contacts[j], points, colour(j)), {kind: loop.of});
  });
  return sets.filter((set, j) => set.kind === kind && (chosen === 'all' || j === +chosen));
}

/* Chart.js takes the ends of a curve for its extremes in x, and a loop has none. */
function frameLoops() {
  const points = loopSets().flatMap(set => set.data);
  for (const name of ['x', 'y']) {
    const values = points.map(p => p[name]);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const more = 0.06 * (high - low) || 1;
    setHome(charts.loops, name, [low - more, high + more]);
  }
}

function nameLoops() {
  const loop = $('contact').value === 'all' ? chosenSolution().loops[0] : chosenSolution().loops[+$('contact').value];
  const [y, x] = loop.of.split(' over ');
  charts.loops.options.scales.x.title.text = x + ' [' + (x[0] === 'T' ? units.force : units.length) + ']';
  charts.loops.options.scales.y.title.text = y + ' [' + units.force + ']';
}

/* What the plots show, in numbers, for those who do not see them. */
function tellSolution() {
  const s = chosenSolution();
  const body = $('shape-table').tBodies[0];
  body.replaceChildren(...data.structure.dofs.map((name, i) => {
    const row = document.createElement('tr');
    const cell = (text, kind) => Object.assign(document.createElement('td'), {textContent: text, className: kind});
    row.append(cell(name, 'text'), ...['amplitude', 'cosine', 'sine'].map(q => cell(show(s[q][i], 6), '')));
    return row;
  }));
  const unit = ' ' + units.force + ' ' + units.length;
  const works = s.loops.map((l, j) => data.structure.contacts[j] + ': ' + show(l.work, 4) + unit);
  $('structure-words').textContent =
    'At ' + solutionWords(s) + (works.length ? ', friction dissipates in a period at contact ' + works.join('; at ') : '') + '.';
}

function drawStructure() {
  if (charts.loops) {
    nameLoops();
    frameLoops();
    redraw('loops');
  }
  redraw('shape');
  zoomReset(charts.shape);
  tellSolution();
}

/* Section 2 has the curve of the chosen response, section 3 its budget. */
function drawChosenResponse() {
  const i = chosenResponse();
  data.response = i === 0 ? firstResponse : data.structure.responses[i - 1];
  charts.budget.options.scales.x.labels = budgetLabels();
  drawResponse();
  redraw('budget');
}

const firstResponse = data.response;

function addOptions(select, names) {
  select.append(...names.map((name, i) => new Option(name, i)));
}

function startStructure() {
  const s = data.structure;
  addOptions($('of-response'), s.names.slice(0, s.responses.length + 1));
  $('of-response').addEventListener('change', drawChosenResponse);
  $('structure-body').hidden = s.solutions.length === 0;
  $('structure-none').hidden = s.solutions.length > 0;
  if (s.solutions.length === 0) return;
  addOptions($('solution'), s.solutions.map(solutionWords));
  addOptions($('contact'), s.contacts.slice(0, s.solutions[0].loops.length));
  const top = s.solutions.map(x => Math.max(...x.amplitude));
  $('solution').value = top.indexOf(Math.max(...top));
  const title = {display: true, text: 'degree of freedom'};
  const x = {type: 'category', labels: s.dofs, title, grid: {display: false}, min: 0, max: s.dofs.length - 1};
  const words = item => s.dofs[item.raw.x] + ': ' + item.dataset.label + ' ' + show(item.raw.y, 5) + ' ' + units.length;
  plot('shape', 'bar', shapeSets, {x, y: axis('x [' + units.length + ']')}, words);
  $('loops-part').hidden = s.solutions[0].loops.length === 0;
  if (s.solutions[0].loops.length) {
    const at = item => 'contact ' + item.dataset.label + ': ' + show(item.raw.x, 5) + ', ' + show(item.raw.y, 5);
    plot('loops', 'scatter', loopSets, {x: axis('u'), y: axis('T')}, at);
  }
  for (const id of ['solution', 'contact', 'shape']) $(id).addEventListener('change', drawStructure);
  drawStructure();
}
