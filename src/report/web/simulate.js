const traces = [], time = result.series.time, lagging = result.outcome === "lagging";
const over = (x, format, quantity, before = "") => `${before}%{x:.6g} ${units[x]}: %{y:${format}} ${units[quantity]}<extra>%{fullData.name}</extra>`;
result.balancers.forEach((b, i) => {
  const name = placed(b.name || "balancer", b.z, 5), line = {color: colours[i % 8], width: 1.5};
  traces.push({x: time.slice(1), y: result.series.amplitude[i].slice(1), name, line, mode: "lines",
    hovertemplate: over("time", ".5g", "amplitude")});
  if (b.amplitude_without_balls > 0)
    traces.push({x: [0, time[time.length - 1]], y: [b.amplitude_without_balls, b.amplitude_without_balls],
      name: "without balls", showlegend: i === 0, line: {color: colours[i % 8], dash: "dot", width: 1}, mode: "lines", hoverinfo: "y"});
});
result.other_starts.forEach((s, i) => traces.push({x: time.slice(1), y: s.amplitude.slice(1), mode: "lines",
  name: `start ${i + 2}: ${s.outcome}`, line: {color: colours[(result.balancers.length + i) % 8], dash: "dash", width: 1.5}, hoverinfo: "x+y+name"}));
result.drawn.angles.forEach((curve, k) => traces.push({x: curve.points.map(p => p[0]), y: curve.points.map(p => p[1]), yaxis: "y2", mode: "lines", name: plain(curve.name),
  line: lineOf(k, {width: 1.5})}));
const changing = Math.max(...result.series.speed) - Math.min(...result.series.speed) > 1e-9 * Math.max(...result.series.speed.map(Math.abs));
// Without balancers: the stations, over time and beside the steady response over speed. With them the curves are those of the balancers.
const stations = result.balancers.length > 0 ? [] : result.stations;
stations.forEach((s, k) => {
  const name = placed(s.name, s.z), line = {color: colours[k % 8], width: 1.5};
  const common = {mode: "lines", legendgroup: "s" + k};
  traces.push({...common, x: time, y: result.series.amplitude[k], name, line, hovertemplate: over("time", ".5g", "amplitude")});
  traces.push({mode: "markers", legendgroup: "s" + k, showlegend: false, x: [s.peak_time], y: [s.peak], name, marker: {color: line.color, size: 8},
    hovertemplate: over("time", ".6g", "amplitude", "peak at ")});
  if (!changing) return; // over one speed there is nothing to see
  traces.push({...common, x: result.series.speed, y: result.series.amplitude[k], name, showlegend: false, line, xaxis: "x2", yaxis: "y2",
    hovertemplate: over("speed", ".5g", "amplitude")});
  if (result.steady.speeds.length > 0)
    traces.push({...common, x: result.steady.speeds, y: result.steady.amplitude[k], name, showlegend: false,
      line: {color: line.color, dash: "dot", width: 1}, xaxis: "x2", yaxis: "y2", hovertemplate: over("speed", ".5g", "amplitude", "steady, ")});
});
if (stations.length > 0 && !changing)
  draw(traces, {height: 480, xaxis: axis(label("Time", "time")), yaxis: axis(label("Amplitude", "amplitude"), {rangemode: "tozero"})});
else if (stations.length > 0)
  draw(traces, {height: 820, grid: {rows: 2, columns: 1, pattern: "independent"}, xaxis: axis(label("Time", "time")), yaxis: axis(label("Amplitude", "amplitude"), {rangemode: "tozero"}),
    xaxis2: axis(label("Spin speed", "speed")), yaxis2: axis(label("Amplitude, steady dotted", "amplitude"), {rangemode: "tozero"})});
else
  draw(traces, {height: 760, xaxis: axis(label("Time", "time"), {anchor: "y2"}),
    yaxis: axis(label("Amplitude", "amplitude"), {type: "log", dtick: 1, exponentformat: "power", domain: [0.52, 1]}),
    yaxis2: axis(lagging ? "Ball speed / rotor speed" : label("Angle in the rotor", "angle"),
      lagging ? {domain: [0, 0.44]} : {domain: [0, 0.44], range: [-190, 190], dtick: 90})});
