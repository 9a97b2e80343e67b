// On paper diagrams are as wide as it (A4 with its margins), however wide the window was.
window.addEventListener("beforeprint", () => document.querySelectorAll(".js-plotly-plot").forEach(plot => {
  plot.style.zoom = 690 / plot.querySelector(".main-svg").width.baseVal.value; // what was drawn, not the window
}));
window.addEventListener("afterprint", () => document.querySelectorAll(".js-plotly-plot").forEach(plot => { plot.style.zoom = ""; }));
