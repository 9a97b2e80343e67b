#include "report/html_scripts.h"

#include "report/html_balance.h"

#include <map>

namespace whirl::report {

namespace {

constexpr const char *common = R"js(
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
)js";

constexpr const char *campbell = R"js(
const traces = [], speeds = result.speeds.map(s => s * rpm), named = {};
const damped = result.modes.some(m => m.log_dec.some(d => d !== null && Math.abs(d) > 1e-9));
const hover = (m, i) => `<b>${m.label}</b> at ${short(speeds[i], 7)} rpm<br>frequency ` +
  (m.frequency[i] === null ? `none (${m.absent[i]})` : `${short(m.frequency[i], 10)} rad/s = ${short(m.frequency[i] * hertz, 10)} Hz`) +
  `<br>real part ${short(m.real[i], 5)} 1/s<br>damping ratio ${short(m.damping_ratio[i], 5)}, log. decrement ${short(m.log_dec[i], 5)}` +
  `<br>${m.whirl[i]} whirl, forward share ${short(m.forward_fraction[i], 4)}` +
  `<br>error ${short(m.error[i], 2)}, residual ${short(m.residual[i], 2)}`;
function stretches(mode, values, panel) {
  let from = 0;
  for (let i = 1; i <= speeds.length; ++i) {
    if (i < speeds.length && mode.whirl[i] === mode.whirl[from]) continue;
    const sense = mode.whirl[from], s = look[sense], x = [], y = [], text = [];
    for (let k = from; k <= Math.min(i, speeds.length - 1); ++k) {
      x.push(speeds[k]); y.push(values[k]); text.push(hover(mode, k));
    }
    traces.push({x, y, text, hoverinfo: "text", mode: "lines+markers", name: sense, legendgroup: sense,
      showlegend: !named[sense], yaxis: panel, line: {color: s.color, dash: s.dash, width: 2},
      marker: {color: s.color, symbol: s.symbol, size: 6, maxdisplayed: Math.max(1, Math.ceil(10 * x.length / speeds.length))}});
    named[sense] = true; from = i;
  }
}
const notes = [];
const last = speeds.length - 1;
result.modes.forEach(m => {
  stretches(m, m.frequency.map(f => f === null ? null : f * hertz), "y");
  if (damped) stretches(m, m.log_dec, "y2");
  if (m.frequency[last] !== null) notes.push({x: speeds[last], y: m.frequency[last] * hertz, text: m.label,
    showarrow: false, xanchor: "left", xshift: 6, font: {color: look[m.whirl[last]].color}});
});
const top = Math.max(0, ...result.modes.flatMap(m => m.frequency.map(f => (f || 0) * hertz))) * 1.05 || 1;
const pixels = (damped ? 0.62 * 770 : 530) / top;
let below = -1e9;
notes.sort((a, b) => a.y - b.y).forEach(n => {
  const height = Math.max(n.y * pixels, below + 13);
  n.yshift = height - n.y * pixels; below = height;
});
const grows = (m, i) => m.real[i] !== null && m.frequency[i] !== null &&
  m.real[i] > Math.max(1e-9, (m.error[i] || 0) + (m.residual[i] || 0)) * Math.hypot(m.real[i], m.frequency[i]);
const ux = [], uy = [], ut = [];
result.modes.forEach(m => {
  speeds.forEach((s, i) => { ux.push(s); uy.push(grows(m, i) ? m.frequency[i] * hertz : null); ut.push(hover(m, i)); });
  ux.push(null); uy.push(null); ut.push("");
});
if (uy.some(y => y !== null)) traces.unshift({x: ux, y: uy, text: ut, hoverinfo: "text", mode: "lines+markers",
  name: "unstable", line: {color: "rgba(224,32,138,0.45)", width: 9}, marker: {size: 3, color: "#E0208A"}});
const multiples = [...new Set([1, ...result.crossings.map(c => c.multiple)])];
multiples.forEach(k => {
  const end = Math.min(speeds[last], 60 * top / k);
  traces.push({x: [speeds[0], end], y: [k * speeds[0] / 60, k * end / 60], mode: "lines", name: k + "×",
    hoverinfo: "name", line: {color: "#777", dash: "dot", width: 1.5}});
});
if (result.crossings.length) traces.push({x: result.crossings.map(c => c.speed * rpm), y: result.crossings.map(c => c.frequency * hertz),
  text: result.crossings.map(c => `crossing of ${result.modes[c.mode].label} with ${c.multiple}×<br>${short(c.speed * rpm, 9)} rpm = ${short(c.speed, 10)} rad/s`),
  hoverinfo: "text", mode: "markers", name: "crossing", marker: {symbol: "circle-open", size: 13, color: "#000", line: {width: 2}}});
draw(traces, {annotations: notes, height: damped ? 860 : 620,
  xaxis: axis("Spin speed (rpm)", {anchor: damped ? "y2" : "y", range: [speeds[0], speeds[last] + 0.05 * (speeds[last] - speeds[0]) || 1]}),
  yaxis: axis("Whirl frequency (Hz)", {range: [0, top], domain: damped ? [0.38, 1] : [0, 1]}),
  ...(damped ? {yaxis2: axis("Logarithmic decrement", {domain: [0, 0.3]})} : {})});
)js";

constexpr const char *critical = R"js(
const traces = Object.keys(look).map(sense => {
  const list = result.critical_speeds.filter(c => c.whirl === sense);
  return {x: list.map(c => c.speed * rpm), y: list.map(() => sense), mode: "markers", name: sense, hoverinfo: "text",
    text: list.map(c => `${sense}: ${short(c.speed, 10)} rad/s = ${short(c.speed * rpm, 10)} rpm<br>error ${short(c.error, 2)}`),
    marker: {color: look[sense].color, symbol: look[sense].symbol, size: 13, line: {width: 2}}};
}).filter(t => t.x.length);
draw(traces, {height: 300, xaxis: axis("Spin speed (rpm)", {rangemode: "tozero"}), yaxis: axis("", {type: "category"}), margin: {l: 90, r: 30, t: 30, b: 60}});
)js";

constexpr const char *response = R"js(
const speeds = result.speeds.map(s => s * rpm), traces = [];
const name = (o, kind) => (o.name || kind) + `, z = ${short(o.z, 4)} m`;
const positive = list => list.map(v => v > 0 ? v : null);
result.nodes.forEach((n, k) => {
  const line = {color: colours[k % 8], dash: dashes[k % 4]}, common = {mode: "lines", line, name: name(n, "node"), legendgroup: "n" + k};
  traces.push({...common, x: speeds, y: positive(n.amplitude).map(a => a === null ? null : a * 1e6), hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} µm"});
  traces.push({...common, x: speeds, y: n.phase.map(p => { if (p === null) return null; const d = p * 180 / Math.PI; return d - 360 * Math.round(d / 360); }),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color}, hovertemplate: "%{x:.5g} rpm<br>%{y:.5g}°"});
});
(result.probes || []).forEach((p, k) => {
  const line = {color: colours[(k + 3) % 8], dash: "dot", width: 2.5}, common = {mode: "lines", line, legendgroup: "p" + k,
    name: name(p, "probe") + ` at ${short(p.angle * 180 / Math.PI, 4)}°`};
  traces.push({...common, x: speeds, y: positive(p.amplitude).map(a => a === null ? null : a * 1e6), hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} µm"});
  traces.push({...common, x: speeds, y: p.phase.map(f => { if (f === null) return null; const d = f * 180 / Math.PI; return d - 360 * Math.round(d / 360); }),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color, symbol: "x"}, hovertemplate: "%{x:.5g} rpm<br>%{y:.5g}°"});
});
result.bearings.forEach((b, k) => traces.push({x: speeds, y: positive(b.force), yaxis: "y3", mode: "lines", name: "force in " + name(b, "bearing"),
  line: {color: colours[k % 8], dash: dashes[(k + 1) % 4], width: 2.5}, hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} N"}));
draw(traces, {height: 950, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 20, b: 60},
  xaxis: axis("Spin speed (rpm)", {anchor: "y3"}), yaxis: axis("Amplitude (µm)", {type: "log", dtick: 1, domain: [0.58, 1], exponentformat: "power"}),
  yaxis2: axis("Phase of x, of a probe (deg)", {domain: [0.32, 0.53], range: [-190, 190], dtick: 90}),
  yaxis3: axis("Bearing force (N)", {type: "log", dtick: 1, domain: [0, 0.27], exponentformat: "power"})});
)js";

/// The page gives `drawnModes`, the curves of each mode.
constexpr const char *modes = R"js(
const traces = [];
result.modes.forEach((m, k) => {
  const yaxis = k ? "y" + (k + 1) : "y", showlegend = k === 0, mode = "lines";
  traces.push({x: result.z, y: drawnModes[k].x, yaxis, name: "x", legendgroup: "x", showlegend, mode, line: {color: "#0072B2", width: 2.5}});
  traces.push({x: result.z, y: drawnModes[k].y, yaxis, name: "y", legendgroup: "y", showlegend, mode, line: {color: "#D55E00", dash: "dash", width: 2.5}});
});
const count = result.modes.length, layout = {height: 120 + 190 * count, xaxis: axis("z (m)", {anchor: count > 1 ? "y" + count : "y"}), annotations: []};
result.modes.forEach((m, k) => {
  const top = 1 - k / count, bottom = 1 - (k + 0.8) / count;
  layout["yaxis" + (k ? k + 1 : "")] = axis("", {domain: [bottom, top], range: [-1.2, 1.2], dtick: 1});
  layout.annotations.push({xref: "paper", yref: "paper", x: 0.01, y: top, xanchor: "left", yanchor: "top", showarrow: false,
    text: `<b>${m.label}</b> ${short(m.frequency * hertz, 7)} Hz, ${m.whirl}; y ` +
      (drawnModes[k].atOneInstant ? "at the same instant" : "a quarter period later"), bgcolor: "rgba(255,255,255,0.8)"});
});
draw(traces, layout);
)js";

constexpr const char *accuracy = R"js(
const families = {};
result.rows.filter(r => r.true_error > 0).forEach(r => {
  const key = r.family === "classical" ? "classical" : "order " + r.order;
  (families[key] = families[key] || []).push(r);
});
const traces = [];
Object.keys(families).forEach((key, k) => {
  const rows = families[key], text = rows.map(r => `<b>${key}</b>, ${r.elements} elements, ${r.unknowns} unknowns<br>${short(r.seconds * 1000, 4)} ms<br>` +
    `true error ${short(r.true_error, 3)}<br>estimate ${short(r.error_estimate, 3)}`);
  [["unknowns", "x", "y", 1], ["seconds", "x2", "y2", 1000]].forEach(([field, xaxis, yaxis, factor], panel) => traces.push({
    x: rows.map(r => r[field] * factor), y: rows.map(r => r.true_error), xaxis, yaxis, text, hoverinfo: "text", mode: "lines+markers",
    name: key, legendgroup: key, showlegend: panel === 0, line: {color: colours[k % 8], dash: dashes[k % 4]}, marker: {symbol: k, size: 8}}));
});
const log = {type: "log", dtick: 1, exponentformat: "power"};
draw(traces, {xaxis: axis("Unknowns", {...log, domain: [0, 0.46]}), xaxis2: axis("Wall time (ms)", {...log, domain: [0.54, 1], anchor: "y2"}),
  yaxis: axis("True relative error", log), yaxis2: axis("", {...log, anchor: "x2", matches: "y"})});
)js";

constexpr const char *simulate = R"js(
const traces = [], time = result.series.time, lagging = result.outcome === "lagging";
const turn = angle => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
result.balancers.forEach((b, i) => {
  const name = `${b.name || "balancer"} at z = ${short(b.z, 5)} m`, line = {color: colours[i % 8], width: 1.5};
  traces.push({x: time.slice(1), y: result.series.amplitude[i].slice(1).map(a => a * 1e6), name, line, mode: "lines",
    hovertemplate: "%{x:.6g} s: %{y:.5g} µm<extra>" + name + "</extra>"});
  if (b.amplitude_without_balls > 0)
    traces.push({x: [0, time[time.length - 1]], y: [1, 1].map(one => one * b.amplitude_without_balls * 1e6),
      name: "without balls", showlegend: i === 0, line: {color: colours[i % 8], dash: "dot", width: 1}, mode: "lines", hoverinfo: "y"});
});
result.other_starts.forEach((s, i) => traces.push({x: time.slice(1), y: s.amplitude.slice(1).map(a => a * 1e6), mode: "lines",
  name: `start ${i + 2}: ${s.outcome}`, line: {color: colours[(result.balancers.length + i) % 8], dash: "dash", width: 1.5}, hoverinfo: "x+y+name"}));
let number = 0;
result.balancers.forEach((b, i) => b.angles.forEach((_, j) => {
  const angles = result.series.angles[number], k = number++, y = [];
  for (let n = 0; n < time.length; ++n)
    y.push(!lagging ? turn(angles[n]) * 180 / Math.PI
      : n === 0 ? null : 1 + (angles[n] - angles[n - 1]) / ((time[n] - time[n - 1]) * result.series.speed[n]));
  if (!lagging)
    for (let n = time.length - 1; n > 0; --n)
      if (Math.abs(y[n] - y[n - 1]) > 180) y[n - 1] = null;
  traces.push({x: time, y, yaxis: "y2", mode: "lines", name: `${b.coordinates[j]} of ${i + 1}`,
    line: {color: colours[k % 8], dash: dashes[Math.floor(k / 8) % 4], width: 1.5}});
}));
draw(traces, {height: 760, xaxis: axis("Time (s)", {anchor: "y2"}),
  yaxis: axis("Amplitude (µm)", {type: "log", dtick: 1, exponentformat: "power", domain: [0.52, 1]}),
  yaxis2: axis(lagging ? "Ball speed / rotor speed" : "Angle in the rotor (deg)",
    lagging ? {domain: [0, 0.44]} : {domain: [0, 0.44], range: [-190, 190], dtick: 90})});
)js";

} // namespace

std::string plot_script(const std::string &command) {
    static const std::map<std::string, const char *> scripts{
        {"campbell", campbell}, {"critical", critical}, {"response", response},
        {"modes", modes},       {"accuracy", accuracy}, {"balance", balance_script},
        {"simulate", simulate}};
    const auto found = scripts.find(command);
    // A function of its own: names such as `top` belong to the window outside.
    return found == scripts.end()
               ? ""
               : std::string("(function () {") + common + found->second + "})();\n";
}

} // namespace whirl::report
