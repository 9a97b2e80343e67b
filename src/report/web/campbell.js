const traces = [], speeds = result.speeds, drawn = result.drawn, named = {};
const damped = result.modes.some(m => m.log_dec.some(d => d !== null && Math.abs(d) > 1e-9));
const hover = (m, i) => `<b>${m.label}</b> at ${said(speeds[i], "speed", 7)}<br>frequency ` +
  (m.frequency[i] === null ? `none (${m.absent[i]})` : said(m.frequency[i], "frequency", 10)) +
  `<br>real part ${said(m.real[i], "rate", 5)}<br>damping ratio ${short(m.damping_ratio[i], 5)}, log. decrement ${short(m.log_dec[i], 5)}` +
  `<br>${drawn.whirl[result.modes.indexOf(m)][i]} whirl, forward share ${short(m.forward_fraction[i], 4)}` +
  `<br>error ${short(m.error[i], 2)}, residual ${short(m.residual[i], 2)}`;
function stretches(mode, values, panel) {
  const sprung = drawn.sprung[result.modes.indexOf(mode)];
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
const others = drawn.others.flatMap(line => [...line, [null, null]]);
if (others.length) traces.push({x: others.map(p => p[0]), y: others.map(p => p[1]), mode: "lines", name: "its other frequency",
  hovertemplate: `%{x:.7g} ${units.speed}: %{y:.10g} ${units.frequency}`, line: {color: "#707070", dash: "dot", width: 1.5}});
const notes = [];
const last = speeds.length - 1;
result.modes.forEach(m => {
  stretches(m, m.frequency, "y");
  if (damped) stretches(m, m.log_dec, "y2");
  if (m.frequency[last] !== null) notes.push({x: speeds[last], y: m.frequency[last], text: drawn.names[result.modes.indexOf(m)],
    showarrow: false, xanchor: "left", xshift: 6, font: {color: look[m.whirl[last]].color}});
});
const top = Math.max(0, ...result.modes.flatMap(m => m.frequency.map(f => f || 0))) * 1.05 || 1;
const pixels = (damped ? 0.62 * 770 : 530) / top;
let below = -1e9;
notes.sort((a, b) => a.y - b.y).forEach(n => {
  const height = Math.max(n.y * pixels, below + 13);
  n.yshift = height - n.y * pixels; below = height;
});
const ux = [], uy = [], ut = [];
result.modes.forEach((m, k) => {
  speeds.forEach((s, i) => { ux.push(s); uy.push(drawn.grows[k][i] ? m.frequency[i] : null); ut.push(hover(m, i)); });
  ux.push(null); uy.push(null); ut.push("");
});
if (uy.some(y => y !== null)) traces.unshift({x: ux, y: uy, text: ut, hoverinfo: "text", mode: "lines+markers",
  name: "unstable", line: {color: "rgba(224,32,138,0.45)", width: 9}, marker: {size: 3, color: "#E0208A"}});
const multiples = [...new Set([1, ...result.crossings.map(c => c.multiple)])];
multiples.forEach(k => {
  const slope = k * drawn.synchronous, end = Math.min(speeds[last], top / slope);
  traces.push({x: [speeds[0], end], y: [slope * speeds[0], slope * end], mode: "lines", name: k + "×",
    hoverinfo: "name", line: {color: "#777", dash: "dot", width: 1.5}});
});
if (result.crossings.length) traces.push({x: result.crossings.map(c => c.speed), y: result.crossings.map(c => c.frequency),
  text: result.crossings.map(c => `crossing of ${result.modes[c.mode].label} with ${c.multiple}×<br>${said(c.speed, "speed", 10)}`),
  hoverinfo: "text", mode: "markers", name: "crossing", marker: {symbol: "circle-open", size: 13, color: result.crossings.map(c => c.heavily_damped ? heavy : "#000"), line: {width: 2}}});
// Decrements above 6.3 (damping ratio 0.7) would flatten all others; a double click shows them.
const decrements = result.modes.flatMap(m => m.log_dec.filter(d => d !== null)), ceiling = 1.08 * Math.min(6.3, Math.max(0, ...decrements));
const decrementRange = [Math.min(1.35 * Math.max(-6.3, Math.min(0, ...decrements)), -0.04 * ceiling), Math.max(ceiling, 0.02)];
draw(traces, {annotations: notes, height: damped ? 860 : 620,
  xaxis: speedAxis({anchor: damped ? "y2" : "y", range: [speeds[0], speeds[last] + 0.05 * (speeds[last] - speeds[0]) || 1]}),
  yaxis: axis(label("Whirl frequency", "frequency"), {range: [0, top], domain: damped ? [0.38, 1] : [0, 1]}),
  ...(damped ? {yaxis2: axis("Logarithmic decrement", {domain: [0, 0.3], range: decrementRange})} : {})});
