// SPDX-License-Identifier: BSD-3-Clause
// The figures of a page as page.h describes them: a specification (data-figures) and a table for each (data-fig-<id>).
'use strict';
(() => {
const { narrow, onPaper, inflateText, unique, finite, largest, smallest, digits, roundDown, css, transparent, plain, kDepthScale, axis, sceneAxis, colourBar, figure } = Charts;

const kSymbols = ['circle', 'square', 'diamond', 'triangle-up', 'cross', 'star', 'triangle-down', 'hexagon'];
const isGrid = ({ kind }) => kind === 'heat' || kind === 'surface';

// ---------------------------------------------------------------- data
// Hands each series its rows; the numbers are the last columns, so commas in names do no harm.
function attach(specification, text) {
  const numbers = specification.roles.slice(2), lines = text.split('\n');
  let line = 1;
  for (const panel of specification.panels) {
    for (const series of panel.series) {
      for (const role of numbers) series[role] = new Float64Array(series.rows);
      for (let row = 0; row < series.rows; ++row, ++line) {
        const fields = lines[line].split(','), first = fields.length - numbers.length;
        for (let c = 0; c < numbers.length; ++c) series[numbers[c]][row] = Number(fields[first + c]);
      }
      if (!isGrid(series)) continue;
      const rows = series.width ? series.rows / series.width : 0, { x, y, z, width } = series;
      series.x = x.slice(0, width);
      series.y = Float64Array.from({ length: rows }, (_, r) => y[r * width]);
      series.lines = Array.from({ length: rows }, (_, r) => z.subarray(r * width, (r + 1) * width));
    }
  }
}

const spacing = (positions) => { const at = unique(finite(Array.from(positions))); let step = Infinity; at.forEach((v, k) => { if (k) step = Math.min(step, v - at[k - 1]); }); return Number.isFinite(step) ? step : 1; };

// ---------------------------------------------------------------- style
// Ours are filled and solid in the colour of their slot; theirs hollow or dashed, and grey where a panel has one of
// them; their bands are grey always.
function styleOf(series, panel) {
  const others = new Set(panel.series.filter(({ theirs, kind }) => theirs && kind !== 'band').map(({ name }) => name));
  const colour = series.theirs && (series.kind === 'band' || others.size === 1) ? css('--theirs') : css(`--s${series.colour + 1}`);
  const symbol = kSymbols[series.colour] + (series.theirs ? '-open' : '');
  return { colour, symbol, dash: series.theirs && series.dash === 'solid' ? 'dash' : series.dash };
}

// ---------------------------------------------------------------- what is drawn of a series
const hover = ({ x, y }, name) => `${name ? plain(name) + '<br>' : ''}${plain(x.title)}: %{x:.5~g}<br>${plain(y.title)}: %{y:.5~g}<extra></extra>`;

function lineTraces(series, panel) {
  const { colour, symbol, dash } = styleOf(series, panel), lines = series.kind !== 'markers', markers = series.kind !== 'line';
  const many = markers && series.rows > 150;
  const trace = { type: 'scatter', x: series.x, y: series.y, mode: [lines && 'lines', markers && 'markers'].filter(Boolean).join('+'), hovertemplate: hover(panel, series.name) };
  if (lines) trace.line = { color: colour, width: 2, dash };
  if (markers) trace.marker = { color: colour, symbol, size: many ? 4 : series.theirs ? 9 : 7, opacity: many ? .6 : 1, line: { width: series.theirs ? 1.6 : 0, color: colour } };
  if (series.edges) {
    trace.error_y = { type: 'data', symmetric: false, array: series.y_high.map((v, k) => v - series.y[k]), arrayminus: series.y_low.map((v, k) => series.y[k] - v),
                      color: colour, thickness: 1.3, width: series.rows > 60 ? 0 : 4 };
  }
  return [trace];
}

// The area between the edges, one closed outline for each stretch without a gap.
function bandTraces(series, panel) {
  const { colour } = styleOf(series, panel), x = [], y = [];
  const low = panel.y.log ? series.y_low.map((v) => v > 0 ? v : smallestPositive(panel)) : series.y_low;
  const good = (k) => k < series.rows && Number.isFinite(series.x[k]) && Number.isFinite(low[k]) && Number.isFinite(series.y_high[k]);
  for (let from = 0; from < series.rows; ++from) {
    if (!good(from)) continue;
    let to = from;
    while (good(to + 1)) ++to;
    for (let k = from; k <= to; ++k) { x.push(series.x[k]); y.push(series.y_high[k]); }
    for (let k = to; k >= from; --k) { x.push(series.x[k]); y.push(low[k]); }
    x.push(null); y.push(null);
    from = to;
  }
  return [{ type: 'scatter', x, y, mode: 'lines', fill: 'toself', line: { width: 0, color: colour }, fillcolor: transparent(colour, series.theirs ? .22 : .2), hoverinfo: 'skip' }];
}
const smallestPositive = (panel) => { let m = Infinity; for (const s of panel.series) for (const role of ['y', 'y_low', 'y_high']) for (const v of s[role] ?? []) if (v > 0 && v < m) m = v; return Number.isFinite(m) ? m : 1; };

// Boxes (and bars, where positions have names) of several series stand beside one another.
function placeOf(series, panel, kind) {
  const all = panel.series.filter((s) => s.kind === kind && s.rows), step = spacing(all.flatMap((s) => Array.from(s.x)));
  const width = (kind === 'box' ? .66 : .8) * step / all.length;
  return { width, offset: (all.indexOf(series) - (all.length - 1) / 2) * width };
}

function boxTraces(series, panel) {
  const { colour } = styleOf(series, panel), { width, offset } = placeOf(series, panel, 'box'), of = (key) => series.boxes.map((box) => box[key]);
  const at = series.boxes.map((box) => box.x + offset);
  const x = series.boxes.flatMap((box, k) => box.outliers.map(() => at[k])), y = series.boxes.flatMap((box) => box.outliers);
  return [{ type: 'box', x: at, q1: of('q1'), median: of('median'), q3: of('q3'), lowerfence: of('low'), upperfence: of('high'), width: .8 * width, whiskerwidth: .5,
            line: { color: colour, width: 1.4 }, fillcolor: transparent(colour, series.theirs ? 0 : .2), hoverinfo: 'y' },
          { type: 'scatter', x, y, mode: 'markers', marker: { color: colour, size: 3.5, opacity: .6 }, hovertemplate: hover(panel, 'outlier'), companion: true }];
}

function barTraces(series, panel) {
  const { colour } = styleOf(series, panel), named = Boolean(panel.x.labels), alone = panel.series.filter(({ kind }) => kind === 'bars').length === 1;
  const { width, offset } = named ? placeOf(series, panel, 'bars') : { width: spacing(series.x), offset: 0 };
  return [{ type: 'bar', x: series.x.map((v) => v + offset), y: series.y, width, hovertemplate: hover(panel, series.name),
            marker: series.theirs ? { color: transparent(colour, .08), line: { color: colour, width: 1.4 } }
                                  : { color: transparent(colour, alone || named ? .78 : .5), line: { color: named ? colour : css('--paper'), width: named ? 0 : 1 } } }];
}

function heatTraces(series, panel, scale) {
  return [{ type: 'heatmap', x: series.x, y: series.y, z: series.lines, coloraxis: scale.name, hoverongaps: false,
            hovertemplate: `${plain(panel.x.title)}: %{x:.5~g}<br>${plain(panel.y.title)}: %{y:.5~g}<br>${plain(series.z_title)}: %{z:.4~g}<extra></extra>` }];
}

// ---------------------------------------------------------------- heights in 3D
function surfaceParts(series, panel, scale) {
  const { x, y, lines, z_unit } = series, columns = x.length, rows = y.length, n = columns * rows;
  const px = new Float32Array(n), py = new Float32Array(n), z = new Float32Array(n);
  for (let r = 0, v = 0; r < rows; ++r) {
    for (let c = 0; c < columns; ++c, ++v) {
      const angle = x[c] * Math.PI / 180;
      px[v] = series.polar ? y[r] * Math.cos(angle) : x[c];
      py[v] = series.polar ? y[r] * Math.sin(angle) : y[r];
      z[v] = lines[r][c];
    }
  }
  // A ring whose last column is not yet its first is closed.
  const closed = series.polar && columns > 2 && x.at(-1) - x[0] < 359.999 && x.at(-1) - x[0] + spacing(x) > 359.5;
  const i = [], j = [], k = [];
  for (let r = 0; r + 1 < rows; ++r) {
    for (let c = 0; c < (closed ? columns : columns - 1); ++c) {
      const next = (c + 1) % columns, [a, b, d, e] = [r * columns + c, r * columns + next, (r + 1) * columns + next, (r + 1) * columns + c];
      if (![a, b, d, e].every((v) => Number.isFinite(z[v]))) continue;
      // Seen from above; an angle against a radius is left-handed.
      if (series.polar) { i.push(a, a); j.push(d, e); k.push(b, d); } else { i.push(a, a); j.push(b, d); k.push(d, e); }
    }
  }
  const extent = Math.max(largest(px) - smallest(px), largest(py) - smallest(py)), heights = finite(Array.from(z)), high = largest(heights), low = smallest(heights);
  const wanted = (series.polar ? .05 : .18) * extent / ((high - low) * z_unit);
  const exaggeration = series.exaggeration || (Number.isFinite(wanted) && wanted > 0 ? roundDown(Math.max(1, wanted)) : 1);
  return { px, py, z, i, j, k, extent, high, low, exaggeration };
}

function surfaceTraces(series, panel, scale, parts) {
  const pz = parts.z.map((v) => v * series.z_unit * parts.exaggeration);
  return [{ type: 'mesh3d', x: parts.px, y: parts.py, z: pz, i: parts.i, j: parts.j, k: parts.k, intensity: parts.z, coloraxis: scale.name, flatshading: false,
            lighting: { ambient: .78, diffuse: .45, specular: .06, roughness: .9, fresnel: .05 }, lightposition: { x: -2000, y: -4000, z: 9000 },
            hoverinfo: 'text', text: Array.from(parts.z, (v) => `${plain(series.z_title)}: ${digits(v)}`) }];
}

function sceneLayout(series, panel, parts) {
  const range = (values) => { const a = smallest(values), b = largest(values), pad = .02 * (b - a) + 1e-9; return [a - pad, b + pad]; };
  const xr = range(parts.px), yr = range(parts.py), factor = series.z_unit * parts.exaggeration, tall = (parts.high - parts.low || 1) * factor;
  const zr = [parts.low * factor - .08 * tall, parts.high * factor + .08 * tall], ratio = (r) => 1.5 * (r[1] - r[0]) / parts.extent;
  const step = roundDown((parts.high - parts.low || 1) / 2), levels = [];
  for (let v = Math.ceil(parts.low / step) * step; v <= parts.high + 1e-9 * step; v += step) levels.push(v);
  const unit = panel.y.title.match(/\[.*\]$/)?.[0] ?? '', far = narrow() ? 1.5 : 1;
  const titles = series.polar ? [`x ${unit}`, `y ${unit}`] : [panel.x.title, panel.y.title];
  return {
    aspectmode: 'manual', aspectratio: { x: ratio(xr), y: ratio(yr), z: ratio(zr) }, dragmode: 'orbit', uirevision: 'kept',
    camera: series.polar ? { eye: { x: 0, y: -1.34 * far, z: 1.56 * far }, center: { x: 0, y: -.2, z: -.12 } }
                         : { eye: { x: .8 * far, y: -1.4 * far, z: 1.2 * far }, center: { x: 0, y: 0, z: -.12 } },
    xaxis: sceneAxis(plain(titles[0]), { range: xr }), yaxis: sceneAxis(plain(titles[1]), { range: yr }),
    // Seen as a whole ring, the heights are too flat for a scale; the colours have one.
    zaxis: sceneAxis(plain(series.z_title), { range: zr, tickvals: levels.map((v) => v * factor), ticktext: levels.map((v) => String(Number(v.toPrecision(3)))), visible: ratio(zr) > .15 }),
  };
}

// ---------------------------------------------------------------- panels in a grid
// Heights of the rows of panels [px]: views in 3D need more, maps less, and paper has little.
function rowHeights(specification, columns) {
  const n = specification.panels.length, rows = Math.ceil(n / columns), out = [];
  for (let r = 0; r < rows; ++r) {
    const kinds = specification.panels.slice(r * columns, (r + 1) * columns).flatMap(({ series }) => series.map(({ kind }) => kind));
    const height = kinds.includes('surface') ? [480, 380] : kinds.includes('heat') ? [270, 250, 220] : [n === 1 ? 340 : 290, 270, 230];
    out.push(Math.round((height[columns - 1] ?? height.at(-1)) * (onPaper() ? .85 : 1)));
  }
  return out;
}

function gridOf(specification, width, legendHeight, bars) {
  // Titles of axes break into lines where the panel is too small for them.
  const lines = (title, room) => wrap(title, Math.max(12, Math.floor(room / 7.4)));
  const n = specification.panels.length, columns = narrow() ? 1 : Math.max(1, Math.min(specification.columns, n));
  const titled = specification.panels.some(({ title }) => title), rows = rowHeights(specification, columns);
  const margin = { l: 66, r: narrow() ? 12 : 18, t: legendHeight + (titled ? 26 : 8), b: 54 };
  if (bars && narrow()) margin.b += 62 * bars; else if (bars) margin.r += 84;
  const about = (width - margin.l - margin.r - 84 * (columns - 1)) / columns, more = 17 * (largest(specification.panels.map((p) => lines(p.x.title, about).length).concat(1)) - 1);
  margin.b += more;
  const gap = { x: 84, y: (titled ? 92 : 72) + more }, tops = rows.map((_, r) => rows.slice(0, r).reduce((sum, h) => sum + h + gap.y, 0));
  const inner = { w: Math.max(80, width - margin.l - margin.r), h: tops.length ? tops.at(-1) + rows.at(-1) : 80 };
  const w = (inner.w - (columns - 1) * gap.x) / columns;
  const domains = specification.panels.map((_, p) => {
    const c = p % columns, r = Math.floor(p / columns), left = c * (w + gap.x);
    return { x: [left / inner.w, (left + w) / inner.w], y: [Math.max(0, 1 - (tops[r] + rows[r]) / inner.h), 1 - tops[r] / inner.h] };
  });
  const titles = specification.panels.map((panel, p) => ({ x: lines(panel.x.title, w).join('<br>'), y: lines(panel.y.title, rows[Math.floor(p / columns)]).join('<br>') }));
  return { domains, titles, margin, inner, height: inner.h + margin.t + margin.b };
}

// Text in lines of at most so many letters, broken at spaces, in long words after a dot, a slash or an underscore.
function wrap(text, letters) {
  const lines = [''];
  for (const piece of text.split(/(?<=[ ./_])/)) {
    if (lines.at(-1) && (lines.at(-1) + piece).trimEnd().length > letters) lines.push('');
    lines[lines.length - 1] += piece;
  }
  return lines.map((line) => plain(line.trimEnd()));
}
const kLetter = 6.9;  // width of a letter of the legend [px], about

// What the legend will take, as plotly sets it: side by side, or in columns as wide as the widest name.
function legendHeight(names, width) {
  if (!names.length) return 0;
  const sizes = names.map((lines) => 48 + kLetter * largest(lines.map((line) => line.length))), room = Math.max(80, width - 84), sum = sizes.reduce((a, b) => a + b, 0);
  const columns = sum <= room ? names.length : Math.max(1, Math.floor(room / largest(sizes)));
  let height = 12;
  for (let n = 0; n < names.length; n += columns) height += 4 + 16.5 * largest(names.slice(n, n + columns).map((lines) => lines.length));
  return height;
}

// 0.002, 5, 1000; beyond that 10⁻⁴, 2·10⁶.
function tick(value) {
  const size = Math.floor(Math.log10(value) + 1e-9), lead = Number((value / 10 ** size).toPrecision(3));
  if (size >= -3 && size <= 4) return String(Number(value.toPrecision(3)));
  return (lead === 1 ? '' : `${lead}·`) + '10' + (size < 0 ? '⁻' : '') + [...String(Math.abs(size))].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]).join('');
}

function axisOf(description, title, values, domain, anchor) {
  const { log, range, labels } = description;
  const out = axis(title, { domain, anchor });
  if (log) {
    const positive = range ?? values.filter((v) => v > 0), from = Math.floor(Math.log10(smallest(positive))) - 1, to = Math.ceil(Math.log10(largest(positive))) + 1;
    const decades = Math.log10(largest(positive) / smallest(positive)), steps = decades < .7 ? [1, 1.5, 2, 3, 4, 5, 6, 8] : decades < 2.2 ? [1, 2, 5] : [1], every = Math.ceil(decades / 8);
    const at = [];
    for (let power = from; power <= to; ++power) if (decades < 8 || power % every === 0) at.push(...steps.map((s) => s * 10 ** power));
    Object.assign(out, { type: 'log', tickmode: 'array', tickvals: at, ticktext: at.map(tick) });
  }
  if (range) out.range = log ? range.map(Math.log10) : range;
  if (labels) Object.assign(out, { tickmode: 'array', tickvals: labels.map(([at]) => at), ticktext: labels.map(([, text]) => plain(text)), showgrid: false, type: log ? 'log' : 'linear' });
  return out;
}

const kTraces = { line: lineTraces, markers: lineTraces, line_markers: lineTraces, band: bandTraces, box: boxTraces, bars: barTraces, heat: heatTraces, surface: surfaceTraces };
// Bands and bars lie behind lines, published values above all.
const kOrder = { heat: 0, surface: 0, bars: 1, band: 2, box: 3, line: 4, line_markers: 5, markers: 6 };

function describe(specification, width) {
  const all = specification.panels.flatMap(({ series }) => series);
  const hasData = (series) => series.kind === 'band' ? finite(Array.from(series.y_high)).length : finite(Array.from(series[isGrid(series) ? 'z' : 'y'])).length;
  if (!all.some(hasData)) return { empty: 'There are no data for this figure.' };
  const named = [...new Set(all.filter(({ name, kind }) => name && !isGrid({ kind })).map(({ name }) => name))];
  const scales = [...new Set(all.filter(isGrid).map(({ z_title }) => z_title))].map((title, n) => ({ title, name: `coloraxis${n ? n + 1 : ''}` }));
  const room = Math.max(16, Math.floor((width - 84 - 48) / kLetter)), legend = legendHeight(named.map((name) => wrap(name, room)), width), grid = gridOf(specification, width, legend, scales.length);
  const layout = {
    margin: grid.margin, height: grid.height, showlegend: named.length > 0, barmode: 'overlay', boxmode: 'overlay', annotations: [], uirevision: 'kept',
    legend: { orientation: 'h', x: 0, xanchor: 'left', y: 1, yref: 'container', yanchor: 'top', font: { size: 12.5 }, traceorder: 'normal' },
  };
  scales.forEach((scale, n) => {
    const values = all.filter((s) => s.z_title === scale.title).flatMap((s) => finite(Array.from(s.z)));
    const high = largest(values), low = smallest(values), bar = colourBar(plain(scale.title), -(54 + 62 * n) / grid.inner.h);
    // Deep is dark, whether depths are given or heights below a surface.
    layout[scale.name] = { colorscale: kDepthScale, reversescale: high <= 0 || (low < 0 && -low > high), cmin: low, cmax: high,
                           colorbar: narrow() ? bar : { ...bar, len: Math.min(1, 420 / grid.inner.h) / scales.length, y: 1 - n / scales.length, yanchor: 'top' } };
  });
  const traces = [], shown = new Set(), notes = [], empty = [];
  let planes = 0, scenes = 0;
  specification.panels.forEach((panel, p) => {
    const domain = grid.domains[p], centre = { xref: 'paper', yref: 'paper', showarrow: false, x: (domain.x[0] + domain.x[1]) / 2 };
    if (panel.title) layout.annotations.push({ ...centre, x: domain.x[0], xanchor: 'left', y: domain.y[1], yanchor: 'bottom', yshift: 3, text: `<b>${plain(panel.title)}</b>`, font: { size: 13 } });
    if (!panel.series.some(hasData)) layout.annotations.push({ ...centre, y: (domain.y[0] + domain.y[1]) / 2, text: 'no data', font: { color: css('--muted') } });
    const scene = panel.series.find(({ kind }) => kind === 'surface');
    if (scene) {
      const name = `scene${++scenes > 1 ? scenes : ''}`, parts = scene.parts ??= surfaceParts(scene, panel);
      layout[name] = { ...sceneLayout(scene, panel, parts), domain };
      traces.push(...surfaceTraces(scene, panel, scales.find(({ title }) => title === scene.z_title), parts).map((trace) => ({ ...trace, scene: name, showlegend: false })));
      notes.push(parts.exaggeration);
      return;
    }
    const suffix = ++planes > 1 ? planes : '', ids = { x: `x${suffix}`, y: `y${suffix}` };
    const values = (role) => panel.series.flatMap((s) => [role, ...(role === 'y' ? ['y_low', 'y_high'] : [])].flatMap((r) => s[r] ? Array.from(s[r]) : []));
    layout[`xaxis${suffix}`] = axisOf(panel.x, grid.titles[p].x, values('x'), domain.x, ids.y);
    if (!panel.x.labels) Object.assign(layout[`xaxis${suffix}`], { tickangle: 0, nticks: Math.max(3, Math.floor((domain.x[1] - domain.x[0]) * grid.inner.w / (narrow() ? 52 : 66))) });
    layout[`yaxis${suffix}`] = axisOf(panel.y, grid.titles[p].y, values('y'), domain.y, ids.x);
    const boxes = unique(panel.series.flatMap((s) => s.boxes?.map(({ x }) => x) ?? []));
    if (boxes.length && boxes.length < 16 && !panel.x.labels && !panel.x.log) Object.assign(layout[`xaxis${suffix}`], { tickmode: 'array', tickvals: boxes, ticktext: boxes.map((v) => String(Number(v.toPrecision(6)))) });
    if (panel.x.equal || panel.y.equal) Object.assign(layout[`yaxis${suffix}`], { scaleanchor: ids.x, constrain: 'domain' });
    if (panel.series.some(({ kind }) => kind === 'heat')) for (const a of ['x', 'y']) layout[`${a}axis${suffix}`].showgrid = false;
    if (panel.series.some(({ kind }) => kind === 'bars') && !panel.y.range && !panel.y.log) layout[`yaxis${suffix}`].rangemode = 'tozero';
    const ordered = [...panel.series].sort((a, b) => kOrder[a.kind] + 10 * a.theirs * (a.kind !== 'band' && a.kind !== 'bars') - kOrder[b.kind] - 10 * b.theirs * (b.kind !== 'band' && b.kind !== 'bars'));
    for (const series of ordered) {
      if (!series.rows) continue;
      for (const { companion, ...trace } of kTraces[series.kind](series, panel, scales.find(({ title }) => title === series.z_title))) {
        const first = Boolean(series.name) && !companion && !isGrid(series) && !shown.has(series.name);
        if (first) shown.add(series.name);
        traces.push({ ...trace, xaxis: ids.x, yaxis: ids.y, name: wrap(series.name, room).join('<br>'), showlegend: first, ...(series.name ? { legendgroup: series.name, legendrank: 1 + named.indexOf(series.name) } : {}) });
      }
    }
  });
  const stated = unique(notes).map((e) => e === 1 ? 'true to scale' : `${e} times too large`);
  return { traces, layout, height: grid.height, caption: stated.length ? `Heights are drawn ${stated.join(' and ')}; drag to turn.` : '',
           buttons: scenes ? ['zoom3d', 'pan3d', 'orbitRotation', 'resetCameraDefault3d'] : undefined };
}

Charts.start(async () => {
  const specifications = JSON.parse(await inflateText('data-figures'));
  const texts = await Promise.all(specifications.map(({ id }) => inflateText(`data-fig-${id}`)));
  specifications.forEach((specification, n) => {
    let attached = false;
    figure(`fig-${specification.id}`, (_controls, _changed, width) => {
      if (!attached) attach(specification, texts[n]);
      attached = true;
      return describe(specification, width);
    }, specification.file, () => texts[n]);
    // The room the figure will take, so that the page does not move while it is read.
    const plot = document.querySelector(`#fig-${specification.id} .plot`);
    plot.style.height = `${gridOf(specification, plot.clientWidth, 32, 0).height}px`;
  });
});
})();
