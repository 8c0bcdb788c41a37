/* ---- start; and, opened with #selftest, the page tries itself (selftest.js) -------------------------------------- */

startResponse();
startBudget();
startAccuracy();
if (data.structure) startStructure();
else startAliasing();
followScheme();

if (location.hash === '#selftest') {
  const out = document.createElement('pre');
  out.id = 'selftest';
  try {
    out.textContent = selfTest();
  } catch (e) {
    out.textContent = 'ERROR: ' + e.message + '\n' + e.stack + '\nselftest: FAILED';
  }
  document.body.prepend(out);
}
