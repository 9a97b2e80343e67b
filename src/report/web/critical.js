const traces = Object.keys(look).map(sense => {
  const list = result.critical_speeds.filter(c => c.whirl === sense);
  return {x: list.map(c => c.speed), y: list.map(() => sense), mode: "markers", name: sense, hoverinfo: "text",
    text: list.map(c => `${sense}: ${said(c.speed, "speed", 10)}<br>error ${short(c.error, 2)}`),
    showlegend: false, marker: {color: list.map(c => c.heavily_damped ? heavy : look[sense].color), symbol: look[sense].symbol, size: 13, line: {width: 2}}};
}).filter(t => t.x.length);
// Keys of their own: that of a trace has the colour of its first point, which may be a grey one.
const key = (name, color, symbol) => ({x: [null], y: [traces[0].y[0]], mode: "markers", name, hoverinfo: "skip", marker: {color, symbol, size: 13, line: {width: 2}}});
if (traces.length) traces.push(...traces.map(t => key(t.name, look[t.name].color, look[t.name].symbol)));
if (result.critical_speeds.some(c => c.heavily_damped)) traces.push(key("heavily damped (AF < 2.5)", heavy, "circle"));
const all = result.critical_speeds.map(c => c.speed), spread = all.length > 0 && Math.min(...all) > 0 && Math.max(...all) > 100 * Math.min(...all);
draw(traces, {height: 300, xaxis: speedAxis(spread ? {type: "log", dtick: 1} : {rangemode: "tozero"}), yaxis: axis("", {type: "category"}), margin: {l: 90, r: 30, t: 30, b: 60}});
