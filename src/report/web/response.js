// Without an imbalance the motion under the weight at twice the spin speed is drawn.
const weight = result.nodes.length === 0 && result.gravity, places = !weight ? result : {probes: [],
  nodes: weight.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.bearings.map(b => ({...b, force: b.twice})),
  curves: {speeds: weight.curves.speeds, nodes: weight.curves.stations.map(s => ({...s, amplitude: s.twice})), bearings: weight.curves.bearings.map(b => ({...b, force: b.twice}))}};
const speeds = result.speeds.map(s => s * rpm), traces = [];
const name = (o, kind) => (o.name || kind ? (o.name || kind) + ", " : "") + `z = ${short(o.z * metres, 4)} m`;
const positive = list => list.map(v => v > 0 ? v : null);
// Curves with points wherever they bend; else those at the speeds of the case.
const fine = (places.curves || {speeds: []}).speeds.length > 0, bends = fine ? places.curves.speeds.map(s => s * rpm) : speeds;
places.nodes.forEach((n, k) => {
  const line = {color: colours[k % 8], dash: dashes[k % 4]}, common = {mode: "lines", line, name: name(n, ""), legendgroup: "n" + k};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.nodes[k].amplitude : n.amplitude).map(a => a === null ? null : a * micrometres), hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} µm"});
  traces.push({...common, x: bends, y: (fine ? places.curves.nodes[k].phase : n.phase).map(p => { if (p === null) return null; const d = p * 180 / Math.PI; return d - 360 * Math.round(d / 360); }),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color}, hovertemplate: "%{x:.5g} rpm<br>%{y:.5g}°"});
});
(places.probes || []).forEach((p, k) => {
  const line = {color: colours[(k + 3) % 8], dash: "dot", width: 2.5}, common = {mode: "lines", line, legendgroup: "p" + k,
    name: name(p, "probe") + ` at ${short(p.angle * 180 / Math.PI, 4)}°`};
  traces.push({...common, x: bends, y: positive(fine ? places.curves.probes[k].amplitude : p.amplitude).map(a => a === null ? null : a * micrometres), hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} µm"});
  traces.push({...common, x: bends, y: (fine ? places.curves.probes[k].phase : p.phase).map(f => { if (f === null) return null; const d = f * 180 / Math.PI; return d - 360 * Math.round(d / 360); }),
    yaxis: "y2", showlegend: false, mode: "markers", marker: {size: 3, color: line.color, symbol: "x"}, hovertemplate: "%{x:.5g} rpm<br>%{y:.5g}°"});
});
places.bearings.forEach((b, k) => traces.push({x: bends, y: positive(fine ? places.curves.bearings[k].force : b.force).map(f => f === null ? null : f * newtons), yaxis: "y3", mode: "lines", name: "force in " + name(b, "bearing"),
  line: {color: colours[k % 8], dash: dashes[(k + 1) % 4], width: 2.5}, hovertemplate: "%{x:.5g} rpm<br>%{y:.6g} N"}));
const range = axis => { const within = logarithmicRange(traces.filter(t => (t.yaxis || "y") === axis).map(t => t.y)); return within ? {range: within} : {}; };
draw(traces, {height: 950, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 20, b: 60},
  xaxis: axis("Spin speed (rpm)", {anchor: "y3"}), yaxis: axis(weight ? "Circle at twice the spin speed (µm)" : "Amplitude (µm)", {type: "log", dtick: 1, domain: [0.58, 1], ...range("y")}),
  yaxis2: axis("Phase of x, of a probe (deg)", {domain: [0.32, 0.53], range: [-190, 190], dtick: 90}),
  yaxis3: axis(weight ? "Bearing force at 2x (N)" : "Bearing force (N)", {type: "log", dtick: 1, domain: [0, 0.27], ...range("y3")})});
