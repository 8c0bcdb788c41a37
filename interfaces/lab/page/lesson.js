/* lesson.js - seven steps: a case, a question with a number to say first, and what the library says. Numbers and cases are
 * in lesson_numbers.js. */
'use strict';

/* What a step draws with its answer: a name for those who do not see it, and how. */
const lessonDrawings = {
  signal: ['Motion, normal and friction force over a period, with the samples', svg => drawSignal(svg, state, seen.motion)],
  spectrum: ['Harmonics of the contact force, true and sampled, and what folds where', svg => drawSpectrum(svg, state, seen.motion)],
  curve: ['Response curve', svg => drawCurve(svg, state, seen, textNow())],
  error: ['Relative error of the amplitude over samples', svg => drawErrorOverN(svg, state, seen.errors && seen.errors.errors, 'error')],
  aliasing: ['What sampling alone costs, over samples', svg => drawErrorOverN(svg, state, seen.errors && seen.errors.errors, 'aliasing')]
};

/* answer(told): words after the number, told as in lesson_numbers.js; right: may a prediction be so far off; drawing: one of
 * lessonDrawings. */
const lessonSteps = [
  {
    title: 'What a sample is blind to',
    text: 'Case 2 has a clearance of 5: the mass hits its contact once a period. At omega = 6 we look N = 16 times a period. A sample sees where x is; it does not see when contact begins or ends.',
    ask: 'How many of the 16 samples find the contact closed?',
    drawing: 'signal',
    right: (said, n) => said === n,
    answer: ({number, facts}) => `${number} of 16. Contact lasts ${percent(facts.share)} of the period, ${show(16 * facts.share, 3)} times the distance of two samples: where it begins and ends lies between samples, and 16 samples would be the same had it lasted somewhat longer or shorter. In the drawing of the force, the orange dots are all that harmonic balance gets.`
  },
  {
    title: 'Where harmonic N - h goes',
    text: 'At 16 samples a period, cos(11 theta) takes exactly the values of another cosine, of a harmonic from 0 to 8. The contact force has a harmonic 11; the sum over samples cannot tell the two apart.',
    ask: 'Onto which harmonic does harmonic 11 fold with N = 16?',
    drawing: 'spectrum',
    right: (said, n) => said === n,
    answer: ({number, facts}) => `Onto ${number} = 16 - 11. The true harmonic 5 is ${show(facts.five, 4)}, harmonic 11 is ${show(facts.eleven, 4)}, and 16 samples say ${show(facts.sampled, 4)} for harmonic 5: with 11 come 21, 27, 37, ... The thick arcs in the spectrum end on it.`
  },
  {
    title: 'Why more harmonics do not help',
    text: 'At omega = 9 and N = 64, H = 5 gives an amplitude that is off by about 0.5 %. With exact forces, more harmonics make the error smaller. Now keep N = 64 and take H = 20.',
    ask: 'By how many per cent is the amplitude off with H = 20 and N = 64?',
    drawing: 'error',
    right: (said, n) => Math.abs(said - n) <= 0.15 * n,
    answer: ({number, facts}) => `${show(number, 3)} %, against ${show(facts.five, 3)} % with H = 5. Exact forces go from ${show(facts.exactFive, 2)} % to ${show(facts.exactTwenty, 2)} %. What is left at N = 64 is what folds, and it does not become smaller by keeping more harmonics: those near N/2 are the worst of all.`
  },
  {
    title: 'Why 1/N and not 1/N\u00b2 at re-contact',
    text: 'The force has kinks, so what folds falls like 1/N\u00b2. But a slider must know where it starts when contact begins again. Many codes start it on the last sample before; the true instant lies somewhere between two samples. Take one motion, and compare sampled and true harmonics for N = 64 to 65536.',
    ask: 'The error falls like N to the power -p. What is p when the slider restarts on a sample?',
    drawing: 'aliasing',
    right: (said, n) => Math.abs(said - n) <= 0.2,
    answer: ({number, facts}) => `p = ${show(number, 3)}: the slider starts up to a whole step 1/N off, and the friction force of the whole contact is off by kt times that. Interpolated between the two samples, p = ${show(facts.interpolated, 3)}. Change \u201cSlider after separation\u201d and see the error over N.`
  },
  {
    title: 'What dropping harmonic 0 costs',
    text: 'The contact pushes one way only, so the mass swings about a mean that is not zero. Some codes keep harmonics 1 to H alone. Omega is 7, H = 10, forces are exact: no sampling in this step.',
    ask: 'By how many per cent does the amplitude change without harmonic 0 (less: negative)?',
    drawing: 'curve',
    right: (said, n) => Math.abs(said - n) <= 5,
    answer: ({number, facts}) => `${show(number, 3)} %: ${show(facts.dropped, 4)} instead of ${show(facts.kept, 4)}. No number of samples or harmonics mends that, since it is another equation that is solved. Turn \u201cHarmonic 0\u201d to kept and see the curve move.`
  },
  {
    title: 'What stiff contact does',
    text: 'A stiffer contact lasts shorter, and its force has more harmonics. With kn = 1000 at omega = 7, N = 128 brings what folds below a thousandth of the force. Now kn is 100 000. Try powers of two.',
    ask: 'How many samples (a power of two) does kn = 100 000 need for the same?',
    drawing: 'spectrum',
    right: (said, n) => said === n,
    answer: ({number, facts}) => `${number}, where kn = 1000 needed ${facts.soft}. Contact time goes with the root of 1/kn, so a hundred times the stiffness shortens it about tenfold at most, and samples are needed where the contact is.`
  },
  {
    title: 'That it can be avoided',
    text: 'The contact force is piecewise linear in x: between the instants at which a contact changes its state, its harmonics have closed forms. Find these instants, integrate between them, and nothing folds. How many samples would be as good? Omega is 9, H = 10.',
    ask: 'From which N on (a power of two) is the sampled amplitude within 1e-6 of the exact forces\u2019?',
    drawing: 'aliasing',
    right: (said, n) => said === n,
    answer: ({number, facts}) => `${number}. Exact forces need no N at all: amplitude ${show(facts.amplitude, 7)}, off by ${show(facts.error, 2)} % from the true motion, which is what H = 10 leaves out and more harmonics do mend. Compare the times of both curves under \u201cWhat it costs\u201d.`
  }
];

const titleOfStep = i => `Step ${i + 1} of the lesson`;
let lessonAt = 0;
const lessonSaid = new Map(); /* of a step: what was predicted */

/* ask(step): has the library say the number; take(state): shows a step's case. */
function startLesson(ask, take) {
  lessonSteps.forEach((step, i) => {
    const button = document.createElement('button');
    Object.assign(button, {type: 'button', textContent: i + 1, title: step.title});
    button.setAttribute('aria-label', `Step ${i + 1}: ${step.title}`);
    button.addEventListener('click', () => goToStep(i, take));
    $('steps').append(button);
  });
  $('step-back').addEventListener('click', () => goToStep(lessonAt - 1, take));
  $('step-next').addEventListener('click', () => goToStep(lessonAt + 1, take));
  $('step-form').addEventListener('submit', event => {
    event.preventDefault();
    if ($('prediction').value === '') return $('prediction').focus();
    lessonSaid.set(lessonAt, Number($('prediction').value));
    $('step-answer').hidden = false;
    $('step-answer').className = 'verdict';
    $('step-answer').textContent = 'Computing.';
    if (!state.title.startsWith(titleOfStep(lessonAt))) take(copyOf(lessonStates[lessonAt]), titleOfStep(lessonAt)); /* the page opens on another case */
    ask(lessonAt);
  });
  showStep();
}

function goToStep(i, take) {
  if (i < 0 || i >= lessonSteps.length) return;
  lessonAt = i;
  take(copyOf(lessonStates[i]), titleOfStep(i));
  showStep();
  $('prediction').focus();
}

function showStep() {
  const step = lessonSteps[lessonAt];
  Array.from($('steps').children).forEach((button, i) => (i === lessonAt ? button.setAttribute('aria-current', 'step') : button.removeAttribute('aria-current')));
  $('step-title').textContent = `Step ${lessonAt + 1}: ${step.title}`;
  $('step-text').innerHTML = `<p>${plain(step.text)}</p>`;
  $('step-ask').textContent = step.ask;
  $('prediction').value = lessonSaid.has(lessonAt) ? lessonSaid.get(lessonAt) : '';
  $('step-answer').hidden = $('step-drawing').hidden = true;
  $('step-back').disabled = lessonAt === 0;
  $('step-next').disabled = lessonAt === lessonSteps.length - 1;
}

/* The library's answer to a step. */
function tellStep(i, told) {
  if (i !== lessonAt) return;
  const step = lessonSteps[i], said = lessonSaid.get(i), right = step.right(said, told.number);
  $('step-answer').className = 'verdict ' + (right ? 'good' : 'open');
  $('step-answer').textContent = `You said ${show(said, 6)}${right ? ', and so it is: ' : '; it is something else: '}${step.answer(told)}`;
  $('step-drawing').hidden = false;
  drawLesson();
}

/* What belongs to the answer, once that is told. */
function drawLesson() {
  if ($('step-drawing').hidden) return;
  const [name, onto] = lessonDrawings[lessonSteps[lessonAt].drawing];
  $('draw-lesson').setAttribute('aria-label', name);
  onto($('draw-lesson'));
}
