"use strict";
const result = JSON.parse(document.getElementById("result").textContent), units = result.units; // of its numbers, by quantity
const look = {
  forward: {color: "#0072B2", dash: "solid", symbol: "circle"},
  backward: {color: "#D55E00", dash: "dash", symbol: "circle-open"},
  mixed: {color: "#007D5A", dash: "dashdot", symbol: "triangle-up-open"}};
const heavy = "#A0A0A0"; // damped so heavily that it counts as no critical speed
const colours = ["#0072B2", "#D55E00", "#007D5A", "#A8527F", "#B77F00", "#3C97CF", "#000000", "#7A7A7A"];
const dashes = ["solid", "dash", "dot", "dashdot"];
// The k-th of many curves: of 32 no two are alike.
const lineOf = (k, more) => ({color: colours[k % 8], dash: dashes[(k + Math.floor(k / 8)) % 4], ...more});
const short = (value, digits) => value === null || value === undefined ? "–" : Number(value.toPrecision(digits)).toString();
const said = (value, quantity, digits) => short(value, digits) + (units[quantity] === "°" ? "" : " ") + units[quantity];
const label = (what, quantity) => `${what} (${units[quantity]})`;
// A name letter by letter: Plotly takes markup in texts for what it means.
const plain = name => name.replace(/[&<>]/g, letter => ({"&": "&amp;", "<": "&lt;", ">": "&gt;"})[letter]);
const placed = (name, z, digits = 4) => (name ? plain(name) + ", " : "") + "z = " + said(z, "length", digits);
const withinTurn = degrees => degrees === null ? null : degrees - 360 * Math.round(degrees / 360);
const axis = (title, more) => Object.assign({title: {text: title}, gridcolor: "#E4E4E4", zerolinecolor: "#999",
  linecolor: "#333", mirror: true, ticks: "outside", exponentformat: "power", minexponent: 5}, more || {});
// Limits of a logarithmic axis, as in the pictures: three powers of ten down from the largest value of the smallest curve, six from that
// of all, so that the start from rest does not squeeze the peaks. A double click shows all.
function logarithmicRange(curves) {
  const largest = curves.map(curve => Math.max(0, ...curve.filter(v => v !== null && isFinite(v)))).filter(v => v > 0);
  const all = curves.flat().filter(v => v > 0);
  if (!largest.length || !all.length) return undefined;
  const low = Math.max(all.reduce((a, b) => Math.min(a, b)), 1e-3 * Math.min(...largest), 1e-6 * Math.max(...largest));
  return [Math.floor(Math.log10(low)), Math.log10(2 * Math.max(...largest))];
}
const speedAxis = more => ({...axis(label("Spin speed", "speed"), more), overSpeed: true});
// A light band over the operating speeds, and a line at the trip speed, where spin speed goes to the right.
function operating(layout) {
  const at = result.operation, across = (from, to, more) => Object.assign({type: "rect", xref: "x", yref: "paper", layer: "below",
    x0: from, x1: to, y0: 0, y1: 1, line: {width: 0}}, more);
  if (!at || !layout.xaxis || !layout.xaxis.overSpeed) return {};
  const name = (speed, text, anchor) => ({x: speed, xref: "x", y: 1, yref: "paper", xanchor: anchor, yanchor: "top", text,
    showarrow: false, textangle: -90, font: {size: 11, color: "#7A5200"}});
  const shapes = [across(at.from, at.to, {fillcolor: "#E3EFDA"})], names = [name(at.from, "operating speeds", "left")];
  if (at.trip !== null) {
    shapes.push(across(at.trip, at.trip, {type: "line", line: {width: 1.5, color: "#7A5200"}}));
    names.push(name(at.trip, "trip", "left"));
  }
  return {shapes: shapes.concat(layout.shapes || []), annotations: (layout.annotations || []).concat(names)};
}
// Drawn again with other numbers, a zoom and what is hidden stay as the reader left them.
function draw(traces, layout, place = "plot") {
  Plotly.react(place, traces, Object.assign({uirevision: "kept", margin: {l: 75, r: 45, t: 30, b: 60}, modebar: {orientation: "v"}, height: 620,
    hovermode: "closest", separators: ".", plot_bgcolor: "#fff", paper_bgcolor: "#fff",
    legend: {orientation: "h", y: 1.02, yanchor: "bottom"}}, layout, operating(layout)), {responsive: true, displaylogo: false});
}
