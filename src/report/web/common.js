"use strict";
const result = JSON.parse(document.getElementById("result").textContent);
const rpm = 30 / Math.PI, hertz = 0.5 / Math.PI;
const look = {
  forward: {color: "#0072B2", dash: "solid", symbol: "circle"},
  backward: {color: "#D55E00", dash: "dash", symbol: "circle-open"},
  mixed: {color: "#007D5A", dash: "dashdot", symbol: "triangle-up-open"}};
const colours = ["#0072B2", "#D55E00", "#007D5A", "#A8527F", "#B77F00", "#3C97CF", "#000000", "#7A7A7A"];
const dashes = ["solid", "dash", "dot", "dashdot"];
const short = (value, digits) => value === null || value === undefined ? "–" : Number(value.toPrecision(digits)).toString();
const axis = (title, more) => Object.assign({title: {text: title}, gridcolor: "#E4E4E4", zerolinecolor: "#999",
  linecolor: "#333", mirror: true, ticks: "outside"}, more || {});
function draw(traces, layout) {
  Plotly.newPlot("plot", traces, Object.assign({margin: {l: 75, r: 30, t: 30, b: 60}, height: 620,
    hovermode: "closest", plot_bgcolor: "#fff", paper_bgcolor: "#fff",
    legend: {orientation: "h", y: 1.02, yanchor: "bottom"}}, layout), {responsive: true, displaylogo: false});
}
