// Without an imbalance the motion under the weight at twice the spin speed is drawn.
const weight = result.nodes.length === 0 && result.gravity, places = !weight ? result : {probes: [],
  nodes: weight.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.bearings.map(b => ({...b, force: b.twice})),
  curves: {speeds: weight.curves.speeds, nodes: weight.curves.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.curves.bearings.map(b => ({...b, force: b.twice}))}};
const traces = [];
const name = (o, kind) => placed(o.name || kind, o.z);
const positive = list => list.map(v => v > 0 ? v : null);
// Curves with points wherever they bend; else those at the speeds of the case.
const fine = (places.curves || {speeds: []}).speeds.length > 0, bends = fine ? places.curves.speeds : result.speeds;
const over = (axis, format) => `%{x:.5g} ${units.speed}<br>%{y:${format}} ${units[axis]}`;
places.nodes.forEach((n, k) => {
  const line = {color: colours[k % 8], dash: dashes[k % 4]}, common = {mode: "lines", line, name: name(n, ""), legendgroup: "n" + k};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.nodes[k].amplitude : n.amplitude), hovertemplate: over("amplitude", ".6g")});
  traces.push({...common, x: bends, y: (fine ? places.curves.nodes[k].phase : n.phase).map(withinTurn),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color}, hovertemplate: over("angle", ".5g")});
});
(places.probes || []).forEach((p, k) => {
  const line = {color: colours[(k + 3) % 8], dash: "dot", width: 2.5}, common = {mode: "lines", line, legendgroup: "p" + k,
    name: name(p, "probe") + " at " + said(p.angle, "angle", 4)};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.probes[k].amplitude : p.amplitude), hovertemplate: over("amplitude", ".6g")});
  traces.push({...common, x: bends, y: (fine ? places.curves.probes[k].phase : p.phase).map(withinTurn),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color, symbol: "x"}, hovertemplate: over("angle", ".5g")});
});
places.bearings.forEach((b, k) => traces.push({x: bends, y: positive(fine ? places.curves.bearings[k].force : b.force), yaxis: "y3", mode: "lines", name: "force in " + name(b, "bearing"),
  line: {color: colours[k % 8], dash: dashes[(k + 1) % 4], width: 2.5}, hovertemplate: over("force", ".6g")}));
const range = axis => { const within = logarithmicRange(traces.filter(t => (t.yaxis || "y") === axis).map(t => t.y)); return within ? {range: within} : {}; };
draw(traces, {height: 950, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 20, b: 60},
  xaxis: speedAxis({anchor: "y3"}), yaxis: axis(label(weight ? "Circle at twice the spin speed" : "Amplitude", "amplitude"), {type: "log", dtick: 1, domain: [0.58, 1], ...range("y")}),
  yaxis2: axis(label("Phase of x, of a probe", "angle"), {domain: [0.32, 0.53], range: [-190, 190], dtick: 90}),
  yaxis3: axis(label(weight ? "Bearing force at 2x" : "Bearing force", "force"), {type: "log", dtick: 1, domain: [0, 0.27], ...range("y3")})});
