const traces = [], speeds = result.speeds.map(s => s * rpm), named = {};
const damped = result.modes.some(m => m.log_dec.some(d => d !== null && Math.abs(d) > 1e-9));
const hover = (m, i) => `<b>${m.label}</b> at ${short(speeds[i], 7)} rpm<br>frequency ` +
  (m.frequency[i] === null ? `none (${m.absent[i]})` : `${short(m.frequency[i], 10)} rad/s = ${short(m.frequency[i] * hertz, 10)} Hz`) +
  `<br>real part ${short(m.real[i], 5)} 1/s<br>damping ratio ${short(m.damping_ratio[i], 5)}, log. decrement ${short(m.log_dec[i], 5)}` +
  `<br>${m.whirl[i]} whirl, forward share ${short(m.forward_fraction[i], 4)}` +
  `<br>error ${short(m.error[i], 2)}, residual ${short(m.residual[i], 2)}`;
// Steps that are no line of the motion, by the rule of the picture (campbell_panel.cpp): its frequency springs.
const highest = Math.max(0, ...result.modes.flatMap(m => m.frequency.map(f => f || 0)));
function springs(mode) {
  const step = i => i < 0 || i + 1 >= speeds.length || mode.frequency[i] === null || mode.frequency[i + 1] === null ? null
    : Math.abs(mode.frequency[i + 1] - mode.frequency[i]);
  const turning = i => (mode.frequency_rotating || [])[i] ?? null; // of its two frequencies the other one is drawn
  const other = i => step(i) !== null && turning(i) !== null && turning(i + 1) !== null &&
    step(i) > (1 + 1e-6) * (result.speeds[i + 1] - result.speeds[i] + Math.abs(turning(i + 1) - turning(i)));
  const large = i => step(i) > 0.04 * highest, sprung = speeds.map((_, i) => other(i));
  for (let i = 0; i + 1 < speeds.length; ++i) {
    if (!large(i) || large(i - 1)) continue;
    const run = large(i + 1) ? 2 : 1, before = step(i - 1), after = step(i + run);
    if (before === null && after === null) continue;
    for (let k = i; k < i + run; ++k) sprung[k] ||= !large(i + run) && step(k) > 5 * Math.max(before || 0, after || 0);
  }
  return sprung;
}
function stretches(mode, values, panel) {
  const sprung = springs(mode);
  let from = 0;
  for (let i = 1; i <= speeds.length; ++i) {
    if (i < speeds.length && mode.whirl[i] === mode.whirl[from]) continue;
    const sense = mode.whirl[from], s = look[sense], x = [], y = [], text = [], end = Math.min(i, speeds.length - 1);
    for (let k = from; k <= end; ++k) {
      x.push(speeds[k]); y.push(values[k]); text.push(hover(mode, k));
      if (sprung[k] && k < end) { x.push(speeds[k]); y.push(null); text.push(""); }
    }
    traces.push({x, y, text, hoverinfo: "text", mode: "lines+markers", name: sense, legendgroup: sense,
      showlegend: !named[sense], yaxis: panel, line: {color: s.color, dash: s.dash, width: 2},
      marker: {color: s.color, symbol: s.symbol, size: 6, maxdisplayed: Math.max(1, Math.ceil(10 * x.length / speeds.length))}});
    named[sense] = true; from = i;
  }
}
// The other frequency of motions that have two (campbell_panel.cpp); where the two change places the lines meet.
const ox = [], oy = [], ot = [];
result.modes.forEach(m => {
  if (!m.other_frequency || m.other_frequency.every(f => f === null)) return;
  const sprung = springs(m), put = (k, f) => { ox.push(speeds[k]); oy.push(f === null ? null : f * hertz); ot.push(f === null ? "" : `<b>${m.label}</b>, its other frequency<br>${short(f, 10)} rad/s = ${short(f * hertz, 10)} Hz`); };
  speeds.forEach((_, i) => {
    put(i, m.other_frequency[i]);
    if (!sprung[i] || i + 1 >= speeds.length) return;
    if (m.other_frequency[i] !== null) put(i + 1, m.frequency[i + 1]);
    put(i, null);
    if (m.other_frequency[i + 1] !== null) put(i, m.frequency[i]);
  });
  put(speeds.length - 1, null);
});
if (oy.some(y => y !== null)) traces.push({x: ox, y: oy, text: ot, hoverinfo: "text", mode: "lines", name: "its other frequency", line: {color: "#707070", dash: "dot", width: 1.5}});
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
  const end = Math.min(speeds[last], top / k * rpm / hertz);
  traces.push({x: [speeds[0], end], y: [k * speeds[0] * hertz / rpm, k * end * hertz / rpm], mode: "lines", name: k + "×",
    hoverinfo: "name", line: {color: "#777", dash: "dot", width: 1.5}});
});
if (result.crossings.length) traces.push({x: result.crossings.map(c => c.speed * rpm), y: result.crossings.map(c => c.frequency * hertz),
  text: result.crossings.map(c => `crossing of ${result.modes[c.mode].label} with ${c.multiple}×<br>${short(c.speed * rpm, 9)} rpm = ${short(c.speed, 10)} rad/s`),
  hoverinfo: "text", mode: "markers", name: "crossing", marker: {symbol: "circle-open", size: 13, color: result.crossings.map(c => c.heavily_damped ? heavy : "#000"), line: {width: 2}}});
// Decrements above 6.3 (damping ratio 0.7) would flatten all others; a double click shows them.
const decrements = result.modes.flatMap(m => m.log_dec.filter(d => d !== null)), ceiling = 1.08 * Math.min(6.3, Math.max(0, ...decrements));
const decrementRange = [Math.min(1.35 * Math.max(-6.3, Math.min(0, ...decrements)), -0.04 * ceiling), Math.max(ceiling, 0.02)];
draw(traces, {annotations: notes, height: damped ? 860 : 620,
  xaxis: axis("Spin speed (rpm)", {anchor: damped ? "y2" : "y", range: [speeds[0], speeds[last] + 0.05 * (speeds[last] - speeds[0]) || 1]}),
  yaxis: axis("Whirl frequency (Hz)", {range: [0, top], domain: damped ? [0.38, 1] : [0, 1]}),
  ...(damped ? {yaxis2: axis("Logarithmic decrement", {domain: [0, 0.3], range: decrementRange})} : {})});
