// Without an imbalance and forces the motion under the weight at twice the spin speed is drawn, or the receptance.
const still = result.nodes.length === 0, weight = still && result.gravity, places = !weight ? result : {probes: [],
  nodes: weight.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.bearings.map(b => ({...b, force: b.twice})),
  curves: {speeds: weight.curves.speeds, nodes: weight.curves.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.curves.bearings.map(b => ({...b, force: b.twice}))}};
const traces = [];
const name = (o, kind) => placed(o.name || kind, o.z);
const positive = list => list.map(v => v > 0 ? v : null);
// Curves with points wherever they bend; else those at the speeds of the case.
const fine = (places.curves || {speeds: []}).speeds.length > 0, bends = fine ? places.curves.speeds : result.speeds;
const over = (axis, format) => `%{x:.5g} ${units.speed}<br>%{y:${format}} ${units[axis]}`;
places.nodes.forEach((n, k) => {
  const line = lineOf(k), common = {mode: "lines", line, name: name(n, ""), legendgroup: "n" + k};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.nodes[k].amplitude : n.amplitude), hovertemplate: over("amplitude", ".6g")});
  traces.push({...common, x: bends, y: (fine ? places.curves.nodes[k].phase : n.phase).map(withinTurn),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color}, hovertemplate: over("angle", ".5g")});
});
(places.probes || []).forEach((p, k) => {
  const line = lineOf(places.nodes.length + k, {width: 2.5}), common = {mode: "lines", line, legendgroup: "p" + k,
    name: name(p, "probe") + " at " + said(p.angle, "angle", 4)};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.probes[k].amplitude : p.amplitude), hovertemplate: over("amplitude", ".6g")});
  traces.push({...common, x: bends, y: (fine ? places.curves.probes[k].phase : p.phase).map(withinTurn),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color, symbol: "x"}, hovertemplate: over("angle", ".5g")});
});
places.bearings.forEach((b, k) => traces.push({x: bends, y: positive(fine ? places.curves.bearings[k].force : b.force), yaxis: "y3", mode: "lines", name: "force in " + name(b, "bearing"),
  line: lineOf(k, {width: 2.5}), hovertemplate: over("force", ".6g")}));
// Resonances, each by its largest peak: of stations, whose amplitudes are drawn.
const rings = ((weight || result).resonances || []).filter(r => r.of === "station" && r.value !== null);
if (rings.length) traces.push({x: rings.map(r => r.speed), y: rings.map(r => r.value), mode: "markers", name: "resonances", hoverinfo: "text",
  text: rings.map(r => `${said(r.speed, "speed", 7)}${r.mode ? ", " + r.mode : ""}<br>${r.kind}${r.amplification === null ? "" : ", AF " + short(r.amplification, 4)}`),
  marker: {symbol: "circle-open", size: 13, color: "#000", line: {width: 2}}});
const swept = still && !weight && result.receptance;
(swept ? swept.receptances : []).forEach((one, k) => ["xx", "xy", "yx", "yy"].forEach((direction, j) => {
  const fine = one[direction].curve.frequencies.length > 0, from = fine ? one[direction].curve : {frequencies: swept.frequencies, ...one[direction]};
  if (!one[direction].amplitude.some(v => v > 0)) return;
  const line = lineOf(4 * k + j), name = `${direction}, ${said(one.from, "length", 4)} to ${said(one.to, "length", 4)}`;
  const over = (axis, format) => `%{x:.5g} ${units.frequency}<br>%{y:${format}} ${units[axis]}`, common = {mode: "lines", line, name, legendgroup: name};
  traces.push({...common, x: from.frequencies, y: positive(from.amplitude), hovertemplate: over("receptance", ".6g")});
  traces.push({...common, x: from.frequencies, y: from.phase.map(withinTurn), yaxis: "y2", showlegend: false, mode: "markers",
    marker: {size: 3, color: line.color}, hovertemplate: over("angle", ".5g")});
}));
const range = axis => { const within = logarithmicRange(traces.filter(t => (t.yaxis || "y") === axis).map(t => t.y)); return within ? {range: within} : {}; };
if (swept) draw(traces, {height: 800, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 20, b: 60},
  xaxis: axis(label("Frequency of the force", "frequency"), {anchor: "y2"}), yaxis: axis(label("Receptance", "receptance"), {type: "log", dtick: 1, domain: [0.4, 1], ...range("y")}),
  yaxis2: axis(label("Phase", "angle"), {domain: [0, 0.33], range: [-190, 190], dtick: 90})});
else draw(traces, {height: 950, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 20, b: 60},
  xaxis: speedAxis({anchor: "y3"}), yaxis: axis(label(weight ? "Circle at twice the spin speed" : "Amplitude", "amplitude"), {type: "log", dtick: 1, domain: [0.58, 1], ...range("y")}),
  yaxis2: axis(label("Phase of x, of a probe", "angle"), {domain: [0.32, 0.53], range: [-190, 190], dtick: 90}),
  yaxis3: axis(label(weight ? "Bearing force at 2x" : "Bearing force", "force"), {type: "log", dtick: 1, domain: [0, 0.27], ...range("y3")})});
