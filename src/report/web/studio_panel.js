"use strict";
// A panel of the studio: puts a result in place of the one before, and draws it with the script of its page.
function carryOut(id, after) {
  const script = document.createElement("script");
  script.textContent = "(function () {\n" + document.getElementById(id).textContent + "\n})();" + (after || "");
  document.body.append(script);
  script.remove();
}
// What a script throws ends up here; the caller asks for it.
let thrown = null;
window.addEventListener("error", event => { thrown = event.message; });
// Returns what went wrong, or null.
window.show = parts => {
  thrown = null;
  const main = document.querySelector("main"), before = document.getElementById("plot");
  const drawn = before !== null && before.classList.contains("js-plotly-plot") ? before : null;
  if (drawn) drawn.remove();
  main.innerHTML = parts.main;
  // The diagram stays the one that is there, so that a zoom stays too.
  const place = document.getElementById("plot");
  if (drawn && place) place.replaceWith(drawn);
  document.getElementById("result").textContent = parts.result;
  carryOut("tables");
  if (place && window.Plotly) carryOut("drawing");
  return thrown;
};
