const traces = [], time = result.series.time, lagging = result.outcome === "lagging";
const turn = angle => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
result.balancers.forEach((b, i) => {
  const name = `${b.name || "balancer"} at z = ${short(b.z * metres, 5)} m`, line = {color: colours[i % 8], width: 1.5};
  traces.push({x: time.slice(1), y: result.series.amplitude[i].slice(1).map(a => a * micrometres), name, line, mode: "lines",
    hovertemplate: "%{x:.6g} s: %{y:.5g} µm<extra>" + name + "</extra>"});
  if (b.amplitude_without_balls > 0)
    traces.push({x: [0, time[time.length - 1]], y: [1, 1].map(one => one * b.amplitude_without_balls * micrometres),
      name: "without balls", showlegend: i === 0, line: {color: colours[i % 8], dash: "dot", width: 1}, mode: "lines", hoverinfo: "y"});
});
result.other_starts.forEach((s, i) => traces.push({x: time.slice(1), y: s.amplitude.slice(1).map(a => a * micrometres), mode: "lines",
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
  traces.push({x: time, y, yaxis: "y2", mode: "lines", name: b.coordinates[j] + (result.balancers.length > 1 ? ", " + (b.name || "balancer " + (i + 1)) : ""),
    line: {color: colours[k % 8], dash: dashes[Math.floor(k / 8) % 4], width: 1.5}});
}));
const changing = Math.max(...result.series.speed) - Math.min(...result.series.speed) > 1e-9 * Math.max(...result.series.speed.map(Math.abs));
// Without balancers: the stations, over time and beside the steady response over speed.
result.stations.forEach((s, k) => {
  const name = (s.name ? s.name + ", " : "") + `z = ${short(s.z * metres, 4)} m`, line = {color: colours[k % 8], width: 1.5};
  const common = {mode: "lines", legendgroup: "s" + k}, micro = list => list.map(a => a === null ? null : a * micrometres);
  traces.push({...common, x: time, y: micro(result.series.amplitude[k]), name, line, hovertemplate: "%{x:.6g} s: %{y:.5g} µm<extra>" + name + "</extra>"});
  traces.push({mode: "markers", legendgroup: "s" + k, showlegend: false, x: [s.peak_time], y: [s.peak * micrometres], marker: {color: line.color, size: 8},
    hovertemplate: "peak at %{x:.6g} s: %{y:.6g} µm<extra>" + name + "</extra>"});
  if (!changing) return; // over one speed there is nothing to see
  traces.push({...common, x: result.series.speed.map(v => v * rpm), y: micro(result.series.amplitude[k]), name, showlegend: false, line, xaxis: "x2", yaxis: "y2",
    hovertemplate: "%{x:.6g} rpm: %{y:.5g} µm<extra>" + name + "</extra>"});
  if (result.steady.speeds.length > 0)
    traces.push({...common, x: result.steady.speeds.map(v => v * rpm), y: micro(result.steady.amplitude[k]), showlegend: false,
      line: {color: line.color, dash: "dot", width: 1}, xaxis: "x2", yaxis: "y2", hovertemplate: "steady, %{x:.6g} rpm: %{y:.5g} µm<extra>" + name + "</extra>"});
});
if (result.stations.length > 0 && !changing)
  draw(traces, {height: 480, xaxis: axis("Time (s)"), yaxis: axis("Amplitude (µm)", {rangemode: "tozero"})});
else if (result.stations.length > 0)
  draw(traces, {height: 820, grid: {rows: 2, columns: 1, pattern: "independent"}, xaxis: axis("Time (s)"), yaxis: axis("Amplitude (µm)", {rangemode: "tozero"}),
    xaxis2: axis("Spin speed (rpm)"), yaxis2: axis("Amplitude, steady dotted (µm)", {rangemode: "tozero"})});
else
  draw(traces, {height: 760, xaxis: axis("Time (s)", {anchor: "y2"}),
    yaxis: axis("Amplitude (µm)", {type: "log", dtick: 1, exponentformat: "power", domain: [0.52, 1]}),
    yaxis2: axis(lagging ? "Ball speed / rotor speed" : "Angle in the rotor (deg)",
      lagging ? {domain: [0, 0.44]} : {domain: [0, 0.44], range: [-190, 190], dtick: 90})});
