// SPDX-License-Identifier: BSD-3-Clause
// The figures of a run's report, drawn from the data blocks of the page.
'use strict';
(() => {
const { $, narrow, inflateText, inflateNumbers, table, times, unique, whereEqual, finite, largest, smallest, digits, roundDown, css, kDepthScale,
        axis, sceneAxis, colourBar, figure, bandTraces } = Charts;

// What the column `revolution` counts: 'revolution', 'cycle', or 'output' where nothing turns.
let counted = 'revolution';

// What the rows are plotted against: revolutions, or time where they do not count up.
function abscissa(revolutions) {
  const turns = revolutions.revolution;
  const rises = turns.length < 2 || turns.every((v, k) => k === 0 || v > turns[k - 1]);
  return rises && counted !== 'output' ? { values: turns, title: `${counted}s [-]`, word: counted }
                                       : { values: revolutions.time_s, title: 'time [s]', word: 'output' };
}

// Lengths of the three axes for ranges of these sizes, the longest being 1. What is long and narrow would be a thread: its
// width is stretched to a quarter of its length. The thin side of a plate stays.
function proportions(sizes) {
  const most = largest(sizes), middle = [...sizes].sort((a, b) => a - b)[1], stretched = middle < most / 8;
  return { stretched, lengths: sizes.map((s) => (stretched && s === middle ? .25 : s / most)) };
}
const kStretched = ' Stretched across its length.';

// ---------------------------------------------------------------- the worn surface in 3D
function surfaceFigure(data, facts, arrays) {
  const facet = facts.surface;
  if (!$('#fig-surface')) return;  // no wall wears
  if (!facet) {
    figure('fig-surface', () => ({ empty: facts.surface_note }), 'surface.csv', () => '');
    figure('fig-map', () => ({ empty: facts.surface_note }), 'wear-map.csv', () => '');
    return;
  }
  const { x, y, z, nx, ny, nz, depth, i, j, k, map } = arrays;
  const polar = facet.map.polar, flat = nz.every((v) => v > 0.999) && largest(z) - smallest(z) < 0.002;
  const v_high = facet.map.v_first + facet.map.v_step * (facet.map.v_count - 1);
  const bandWidth = polar ? v_high - facet.map.v_first : Math.min(facet.map.u_step * facet.map.u_count, facet.map.v_step * facet.map.v_count);
  const extent = Math.max(largest(x) - smallest(x), largest(y) - smallest(y));

  // The close-up: a piece about four band widths long, nearest to the reader (towards -y).
  function closeUp() {
    const half = 2 * bandWidth, middle = (largest(x) + smallest(x)) / 2;
    const near = (v) => Math.abs(x[v] - (polar ? 0 : middle)) < half && (!polar || y[v] < 0);
    const keep = [];
    for (let t = 0; t < i.length; ++t) if (near(i[t]) && near(j[t]) && near(k[t])) keep.push(t);
    return keep;
  }
  function selection(view) {
    if (view === 'whole') return { x, y, z, nx, ny, nz, depth, i, j, k };
    const keep = closeUp(), number = new Map(), source = [];
    const rename = (v) => { if (!number.has(v)) { number.set(v, source.length); source.push(v); } return number.get(v); };
    const corners = [i, j, k].map((corner) => keep.map((t) => rename(corner[t])));
    const pick = (values) => Float32Array.from(source, (v) => values[v]);
    return { x: pick(x), y: pick(y), z: pick(z), nx: pick(nx), ny: pick(ny), nz: pick(nz), depth: pick(depth),
             i: corners[0], j: corners[1], k: corners[2] };
  }

  const defaults = { whole: roundDown(Math.max(1, 0.03 * extent / (facet.max_depth_um / 1000))),
                     close: roundDown(Math.max(1, 0.45 * bandWidth / (facet.max_depth_um / 1000))) };
  let chosen = null, parts = {};

  function draw(controls, changed) {
    const view = controls.view.value;
    if (changed !== 'exaggeration') chosen = changed === 'view' || chosen === null ? defaults[view] : chosen;
    else chosen = Number(controls.exaggeration.value);
    const menu = unique([1, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000].filter((e) => e * facet.max_depth_um / 1000 < extent).concat(chosen));
    controls.exaggeration.replaceChildren(...menu.map((e) => new Option('× ' + e, e, false, e === chosen)));
    const s = parts[view] ??= selection(view);
    const n = s.x.length, sink = (values, normal) => Float32Array.from({ length: n }, (_, v) => values[v] - normal[v] * s.depth[v] * chosen / 1000);
    const px = sink(s.x, s.nx), py = sink(s.y, s.ny), pz = sink(s.z, s.nz);
    const range = (values) => { const a = smallest(values), b = largest(values), pad = 0.02 * (b - a) + 1e-6; return [a - pad, b + pad]; };
    const xr = range(px), yr = range(py);
    const z0 = s.z[0], sunk = facet.max_depth_um * chosen / 1000;
    const zr = flat ? [z0 - 1.1 * sunk, z0 + 0.35 * sunk] : range(pz);
    const size = Math.max(xr[1] - xr[0], yr[1] - yr[0], flat ? 0 : zr[1] - zr[0]), scale = view === 'whole' ? (flat ? 1.55 : 1.25) : 1.5;
    const far = narrow() ? (view === 'whole' ? 1.75 : 1.95) : view === 'whole' ? 1.2 : 1;
    const ratio = (r) => scale * (r[1] - r[0]) / size, shape = proportions([xr, yr, flat ? [0, 0] : zr].map((r) => r[1] - r[0]));
    const across = (k, r) => (view === 'whole' && shape.stretched ? scale * shape.lengths[k] : ratio(r));
    const step = roundDown(facet.max_depth_um / (narrow() ? 1 : 1.9)), levels = [0];
    while (levels.length < 6 && levels.at(-1) + step <= facet.max_depth_um * 1.05) levels.push(levels.at(-1) + step);
    const zAxis = flat ? { tickvals: levels.map((d) => z0 - d * chosen / 1000),
                           ticktext: levels.map((d) => d === 0 ? '0' : '−' + Number(d.toPrecision(3))) } : {};
    return {
      traces: [{
        type: 'mesh3d', x: px, y: py, z: pz, i: s.i, j: s.j, k: s.k, intensity: s.depth, cmin: 0, cmax: facet.max_depth_um,
        colorscale: kDepthScale, flatshading: false, lighting: { ambient: .78, diffuse: .45, specular: .06, roughness: .9, fresnel: .05 },
        lightposition: { x: -2000, y: -4000, z: 9000 }, hoverinfo: 'text',
        text: Array.from(s.depth, (d, v) => `x ${s.x[v].toFixed(2)} mm<br>y ${s.y[v].toFixed(2)} mm<br>depth ${digits(d)} µm`),
        colorbar: narrow() ? { orientation: 'h', y: -0.02, yanchor: 'top', thickness: 12, len: .9, title: { text: 'depth [µm]', side: 'top' }, outlinewidth: 0, tickfont: { size: 11.5 }, exponentformat: 'power' }
                           : { thickness: 14, len: .75, x: 1.0, title: { text: 'depth [µm]', side: 'top' }, outlinewidth: 0, tickfont: { size: 12 }, exponentformat: 'power' },
      }],
      layout: {
        margin: { l: 0, r: 0, t: 8, b: narrow() ? 50 : 8 }, uirevision: view, dragmode: 'orbit',
        scene: {
          uirevision: view, dragmode: 'orbit', aspectmode: 'manual', aspectratio: { x: across(0, xr), y: across(1, yr), z: flat ? ratio(zr) : across(2, zr) },
          camera: view === 'whole' && !flat ? { eye: { x: .9 * far, y: -1.35 * far, z: far }, center: { x: 0, y: 0, z: -.1 } }
                : view === 'whole' ? { eye: { x: 0, y: -1.12 * far, z: 1.3 * far }, center: { x: 0, y: -.2, z: -.12 } }
                                   : { eye: { x: .6 * far, y: -1.0 * far, z: .85 * far }, center: { x: .03, y: 0, z: -.08 } },
          xaxis: sceneAxis('x [mm]', { range: xr }), yaxis: sceneAxis('y [mm]', { range: yr, nticks: view === 'whole' ? 5 : 3 }),
          // Seen whole, a flat track is too thin for a scale of its height; the colour bar has it.
          zaxis: sceneAxis(flat ? 'height [µm]' : 'z [mm]', { ...zAxis, range: zr, visible: !(flat && view === 'whole') }),
        },
      },
      buttons: ['zoom3d', 'pan3d', 'orbitRotation', 'resetCameraDefault3d'],
      caption: `The worn band of the wall: ${facet.triangles.toLocaleString('en').replaceAll(',', '\u202f')} of its ${facet.mesh_triangles.toLocaleString('en').replaceAll(',', '\u202f')} triangles`
             + `${facet.resampled ? ', resampled on a grid' : ''}. Deepest point ${digits(facet.max_depth_um)} µm; depth is drawn ${chosen} times too large.${view === 'whole' && shape.stretched ? kStretched : ''} Drag to turn, ${narrow() ? 'pinch' : 'scroll'} to zoom.`,
    };
  }
  figure('fig-surface', draw, 'surface.csv', () => {
    let text = 'x_mm,y_mm,z_mm,depth_um\n';
    for (let v = 0; v < x.length; ++v) text += `${x[v].toFixed(3)},${y[v].toFixed(3)},${z[v].toFixed(3)},${depth[v].toFixed(4)}\n`;
    return text;
  });

  const m = facet.map, u = Array.from({ length: m.u_count }, (_, c) => m.u_first + c * m.u_step);
  const v = Array.from({ length: m.v_count }, (_, r) => m.v_first + r * m.v_step);
  figure('fig-map', () => ({
    traces: [{
      type: 'heatmap', x: u, y: v, z: v.map((_, r) => map.subarray(r * m.u_count, (r + 1) * m.u_count)), zmin: 0, zmax: facet.max_depth_um,
      colorscale: kDepthScale, hoverongaps: false,
      hovertemplate: polar ? 'angle %{x:.1f}°<br>radius %{y:.3f} mm<br>depth %{z:.3f} µm<extra></extra>' : 'x %{x:.3f} mm<br>y %{y:.3f} mm<br>depth %{z:.3f} µm<extra></extra>',
      colorbar: colourBar('depth [µm]'),
    }],
    layout: { margin: { l: 60, r: 10, t: 10, b: narrow() ? 110 : 48 },
              xaxis: axis(polar ? 'angle [°]' : 'x [mm]', { showgrid: false, ...(polar ? { tickvals: [0, 60, 120, 180, 240, 300, 360], range: [0, 360] } : {}) }),
              yaxis: axis(polar ? 'radius [mm]' : 'y [mm]', { showgrid: false }) },
    caption: polar ? 'Depth below the unworn surface after the last output, the track unrolled along its angle.' : 'Depth below the unworn surface after the last output, seen from above.',
  }), 'wear-map.csv', () => {
    let text = polar ? 'angle_deg,radius_mm,depth_um\n' : 'x_mm,y_mm,depth_um\n';
    v.forEach((vv, r) => u.forEach((uu, c) => { const d = map[r * m.u_count + c]; if (!Number.isNaN(d)) text += `${uu.toFixed(3)},${vv.toFixed(4)},${d.toFixed(4)}\n`; }));
    return text;
  });
}

// ---------------------------------------------------------------- what the walls suffered, in 3D
function wearMapFigure(map, arrays) {
  if (!map) return;
  const { x, y, z, i, j, k } = arrays, count = (n) => n.toLocaleString('en').replaceAll(',', '\u202f');
  figure('fig-wear-map', (controls) => {
    const wall = map.walls[Number(controls.wall.value)], quantity = map.quantities.find(({ key }) => key === controls.quantity.value);
    const [v0, vertices] = wall.vertices, [t0, triangles] = wall.triangles, part = (values) => values.subarray(v0, v0 + vertices);
    const corners = [i, j, k].map((corner) => Array.from(corner.subarray(t0, t0 + triangles), (v) => v - v0));
    const values = Array.from(arrays[quantity.key].subarray(t0, t0 + triangles)), most = largest(values);
    if (!(most > 0)) return { empty: `This wall has no ${quantity.title.replace(/ \[.*\]$/, '')}.` };
    const [px, py, pz] = [part(x), part(y), part(z)];
    const range = (p) => { const a = smallest(p), b = largest(p), pad = 0.02 * (b - a) + 1e-6; return [a - pad, b + pad]; };
    const ranges = [range(px), range(py), range(pz)], shape = proportions(ranges.map((r) => r[1] - r[0])), far = narrow() ? 1.6 : 1.3;
    // Axes of a thin wall would crowd: its short side has none.
    const ratio = (k) => Math.max(.02, 1.4 * shape.lengths[k]), shown = (k) => ratio(k) > .15;
    return {
      traces: [{
        type: 'mesh3d', x: px, y: py, z: pz, i: corners[0], j: corners[1], k: corners[2], intensity: values, intensitymode: 'cell', cmin: 0, cmax: most,
        colorscale: kDepthScale, flatshading: true, lighting: { ambient: .85, diffuse: .35, specular: .03, roughness: .95, fresnel: .02 },
        lightposition: { x: -2000, y: -4000, z: 9000 }, hoverinfo: 'none',
        colorbar: narrow() ? { orientation: 'h', y: -0.02, yanchor: 'top', thickness: 12, len: .9, title: { text: quantity.title, side: 'top' }, outlinewidth: 0, tickfont: { size: 11.5 }, exponentformat: 'power' }
                           : { thickness: 14, len: .75, x: 1.0, title: { text: quantity.title, side: 'top' }, outlinewidth: 0, tickfont: { size: 12 }, exponentformat: 'power' },
      }],
      layout: {
        margin: { l: 0, r: 0, t: 8, b: narrow() ? 50 : 8 }, uirevision: wall.name, dragmode: 'orbit',
        scene: { uirevision: wall.name, dragmode: 'orbit', aspectmode: 'manual', aspectratio: { x: ratio(0), y: ratio(1), z: ratio(2) },
                 camera: { eye: { x: .9 * far, y: -1.35 * far, z: 1.0 * far }, center: { x: 0, y: 0, z: -.1 } },
                 xaxis: sceneAxis('x [mm]', { range: ranges[0], visible: shown(0) }), yaxis: sceneAxis('y [mm]', { range: ranges[1], nticks: 4, visible: shown(1) }),
                 zaxis: sceneAxis('z [mm]', { range: ranges[2], visible: shown(2) }) },
      },
      buttons: ['zoom3d', 'pan3d', 'orbitRotation', 'resetCameraDefault3d'],
      caption: `'${wall.name}' in its last shape, ${triangles < wall.mesh_triangles ? `the ${count(triangles)} of its ${count(wall.mesh_triangles)} triangles under the greatest pressure` : `${count(triangles)} triangles`}. `
             + `Most on one of them: ${digits(most)} ${quantity.title.match(/\[(.*)\]$/)[1].replace('-', '')}`.trimEnd() + `.${shape.stretched ? kStretched : ''} Drag to turn, ${narrow() ? 'pinch' : 'scroll'} to zoom.`,
    };
  }, 'wall-maps.csv', () => {
    let text = `wall,${map.quantities.map(({ key }) => key).join(',')},x_mm,y_mm,z_mm\n`;
    map.walls.forEach((wall, w) => {
      for (let t = wall.triangles[0]; t < wall.triangles[0] + wall.triangles[1]; ++t) {
        const middle = [x, y, z].map((p) => ((p[i[t]] + p[j[t]] + p[k[t]]) / 3).toFixed(3));
        text += `${w},${map.quantities.map(({ key }) => Number(arrays[key][t].toPrecision(7))).join(',')},${middle.join(',')}\n`;
      }
    });
    return text;
  });
}

// ---------------------------------------------------------------- volume
function volumeFigure({ revolutions }, { measured }) {
  if (!$('#fig-volume')) return;
  figure('fig-volume', () => {
    if (!revolutions.rows) return { empty: 'No revolution was completed, so there is no volume to plot.' };
    const along = abscissa(revolutions), mode = revolutions.rows <= 60 ? 'lines+markers' : 'lines';
    const curve = (name, column, color, line, symbol) => ({
      x: along.values, y: revolutions[column], name, mode, line: { color: css(color), ...line }, marker: { color: css(color), symbol, size: 7 },
      hovertemplate: `${name}<br>${along.word} %{x:.6~g}<br>%{y:.4~g} mm³<extra></extra>` });
    const traces = [];
    if (measured.volume_mm3) {
      const [mean, sd] = measured.volume_mm3, from = Math.min(0, along.values[0]), to = along.values.at(-1);
      traces.push(...bandTraces(from, to, mean - sd, mean + sd, `measured, ${digits(mean)} ± ${digits(sd, 2)} mm³`));
    }
    traces.push(curve('mesh', 'swept_volume_mm3', '--s1', { width: 4 }, 'circle'),
                curve('law', 'law_volume_mm3', '--s2', { width: 1.8, dash: 'dash' }, 'diamond-open'));
    if (finite(Array.from(revolutions.paper_volume_mm3)).length)
      traces.push(curve('paper\u2019s measure', 'paper_volume_mm3', '--s4', { width: 1.8, dash: 'dot' }, 'square-open'));
    return { traces, layout: { xaxis: axis(along.title, { rangemode: 'tozero' }), yaxis: axis('wear volume [mm³]', { rangemode: 'tozero' }) },
             caption: 'Mesh: what the wall lost. Law: the sum of α F v dt. Paper\u2019s measure: its equations 10 to 12 over the elements in contact.'
                    + (measured.volume_mm3 ? ' The band is the laboratory\u2019s mean and one standard deviation.' : '') };
  }, 'revolutions.csv', () => revolutions.csv);
}

// ---------------------------------------------------------------- contours
function profileFigure({ profiles }, { thinned }) {
  const turns = unique(profiles.revolution);
  const menu = $('#fig-profiles [data-control="revolution"]');
  menu.previousSibling.textContent = `After ${counted} `;
  menu.replaceChildren(...turns.map((t) => new Option(digits(t, 1 + Math.floor(Math.log10(Math.max(1, t)))), t, false, t === turns.at(-1))));
  figure('fig-profiles', (controls) => {
    if (!profiles.rows) return { empty: 'The run recorded no contours.' };
    const rows = whereEqual(profiles.revolution, Number(controls.revolution.value));
    const angles = unique(rows.map((r) => profiles.angle_deg[r]));
    const traces = angles.map((angle, n) => {
      const mine = rows.filter((r) => profiles.angle_deg[r] === angle).sort((a, b) => profiles.radius_mm[a] - profiles.radius_mm[b]);
      return { x: mine.map((r) => profiles.radius_mm[r]), y: mine.map((r) => 1000 * profiles.height_mm[r]), name: `${Number(angle.toFixed(1))}°`,
               mode: 'lines', line: { color: css('--s' + (n % 8 + 1)), width: 1.7, dash: n < 8 ? 'solid' : 'dash' },
               hovertemplate: `${Number(angle.toFixed(1))}°<br>radius %{x:.3f} mm<br>height %{y:.3f} µm<extra></extra>` };
    });
    return { traces, layout: { uirevision: 'profiles', xaxis: axis('radius [mm]'), yaxis: axis('height [µm]') },
             caption: `Cuts across the track after ${counted} ${Number(Number(controls.revolution.value).toPrecision(6))}, at the angles named; heights in µm over radii in mm, so depth is greatly exaggerated.` + (thinned.profiles ? ' Some revolutions are left out here; tables/profiles.csv has all.' : '') };
  }, 'profiles.csv', () => profiles.csv);
}

// ---------------------------------------------------------------- distributions
function spreadFigure(id, { contours, revolutions }, { column, factor, unit, noun, test, color }) {
  const turn = contours.rows ? largest(contours.revolution) : NaN;
  const values = finite(whereEqual(contours.revolution, turn).map((r) => factor * contours[column][r]));
  figure(id, () => {
    if (values.length < 2) return { empty: 'The run recorded no contours.' };
    const n = values.length, mean = values.reduce((a, b) => a + b, 0) / n;
    const sd = Math.sqrt(values.reduce((a, b) => a + (b - mean) ** 2, 0) / (n - 1));
    const low = smallest(values), high = largest(values);
    const count = Math.max(5, Math.round(1.2 * Math.sqrt(n))), step = high > low ? (high - low) / count : Math.max(1e-6, 1e-3 * Math.abs(high));
    const traces = [{ type: 'histogram', x: values, xbins: { start: low, end: high + 1e-9 * step + (high > low ? 0 : step), size: step }, autobinx: false, name: 'contours',
                      marker: { color: css(color), opacity: .75, line: { color: css('--paper'), width: 1 } }, hovertemplate: `%{x} ${unit}<br>%{y} contours<extra></extra>` }];
    if (sd > 0) {
      const xs = Array.from({ length: 121 }, (_, s) => mean + sd * (s / 20 - 3));
      traces.push({ x: xs, y: xs.map((v) => n * step * Math.exp(-0.5 * ((v - mean) / sd) ** 2) / (sd * Math.sqrt(2 * Math.PI))), mode: 'lines',
                    name: 'normal, same mean and sd', line: { color: css('--ink'), width: 1.6 }, hoverinfo: 'skip' });
    }
    const row = revolutions.revolution.lastIndexOf(turn), p = row >= 0 ? revolutions[test][row] : NaN;
    const verdict = Number.isFinite(p) ? ` χ² test of normality: p = ${digits(p, 2)}, ${p < 0.05 ? 'so a normal distribution is rejected' : 'so a normal distribution is not rejected'} at 5 %.` : '';
    return { traces, layout: { bargap: 0.02, xaxis: axis(`${noun} [${unit}]`), yaxis: axis('contours [-]', { rangemode: 'tozero' }),
                               shapes: [{ type: 'line', x0: mean, x1: mean, y0: 0, y1: 1, yref: 'paper', line: { color: css('--ink'), width: 1.2, dash: 'dash' } }] },
             caption: `${n} contours after ${counted} ${Number(turn.toPrecision(6))}: mean ${digits(mean)} ${unit} (dashed), sd ${digits(sd, 2)} ${unit}.${verdict}` };
  }, 'contours.csv', () => contours.csv);
}

function growthFigure(id, { revolutions }, { mean, sd, low, high, factor, unit, noun, color, range }) {
  figure(id, () => {
    if (!revolutions.rows) return { empty: 'No revolution was completed.' };
    const along = abscissa(revolutions), x = along.values;
    const middle = times(revolutions[mean], factor), spread = times(revolutions[sd], factor);
    const traces = [];
    if (range) traces.push(...bandTraces(Math.min(0, x[0]), x.at(-1), range[0], range[1], `measured, ${digits(range[0], 2)} to ${digits(range[1], 2)} ${unit}`));
    const quiet = { mode: 'lines', line: { width: 0 }, hoverinfo: 'skip' };
    traces.push({ ...quiet, x, y: middle.map((v, k) => v - spread[k]), showlegend: false },
                { ...quiet, x, y: middle.map((v, k) => v + spread[k]), fill: 'tonexty', fillcolor: css('--s1-band'), name: '± 1 sd' },
                { x, y: middle, name: 'mean', mode: revolutions.rows <= 60 ? 'lines+markers' : 'lines', line: { color: css('--s1'), width: 2.2 }, marker: { size: 6 },
                  hovertemplate: `${along.word} %{x:.6~g}<br>mean %{y:.4~g} ${unit}<extra></extra>` });
    const limit = (column, name) => ({ x, y: times(revolutions[column], factor), name, mode: 'lines', line: { color: css('--muted'), width: 1, dash: 'dot' },
                                       hovertemplate: `${along.word} %{x:.6~g}<br>${name} %{y:.4~g} ${unit}<extra></extra>` });
    if (low) traces.push({ ...limit(high, 'largest'), name: 'smallest, largest', legendgroup: 'limits' }, { ...limit(low, 'smallest'), showlegend: false, legendgroup: 'limits' });
    return { traces, layout: { xaxis: axis(along.title, { rangemode: 'tozero' }), yaxis: axis(`${noun} [${unit}]`, { rangemode: 'tozero' }) },
             caption: `Over all contours of each ${along.word}: mean, one standard deviation either side${low ? ', smallest and largest' : ''}.${range ? ' The wide band is what the laboratory measured.' : ''}` };
  }, 'revolutions.csv', () => revolutions.csv);
}

// ---------------------------------------------------------------- forces
function boxFigure({ force }) {
  const whole = force.revolution.every((r) => Number.isInteger(r));
  const turn = Array.from(force.revolution, (r) => whole ? r : Math.max(1, Math.ceil(r - 1e-9)));
  figure('fig-boxes', () => {
    if (!force.rows) return { empty: 'The run recorded no forces.' };
    const all = unique(turn), most = narrow() ? 14 : 36;
    const shown = all.length <= most ? all : Array.from({ length: most }, (_, k) => all[Math.round(k * (all.length - 1) / (most - 1))]);
    const wanted = new Set(shown), x = [], y = [];
    turn.forEach((t, r) => { if (wanted.has(t)) { x.push(String(t)); y.push(force.normal_force_N[r]); } });
    return { traces: [{ type: 'box', x, y, boxpoints: 'outliers', line: { color: css('--s1'), width: 1.3 }, fillcolor: css('--s1-band'), name: '',
                        marker: { color: css('--s1'), size: 3, opacity: .6 }, showlegend: false }],
             layout: { margin: { l: 56, r: 12, t: 12, b: 48 }, boxgap: .35, xaxis: axis(`${counted} [-]`, { type: 'category', showgrid: false }), yaxis: axis('normal force [N]') },
             caption: 'Normal force between the loaded particle and the wall. Boxes: quartiles and median. Whiskers: the farthest samples within 1.5 times the box. Points: outliers.'
                    + (shown.length < all.length ? ` ${shown.length} of ${all.length} ${counted}s, evenly spread.` : '') };
  }, 'force.csv', () => force.csv);
}

function forceFigure({ force }, { thinned }) {
  figure('fig-force', (controls) => {
    if (!force.rows) return { empty: 'The run recorded no forces.' };
    const curve = (column, name, unit, color) => ({ x: force.time_s, y: force[column], name, mode: 'lines', line: { color: css(color), width: 1.1 },
                                                    hovertemplate: `%{x:.5~g} s<br>%{y:.4~g} ${unit}<extra>${name}</extra>` });
    const quantity = { force: ['force [N]', curve('normal_force_N', 'normal', 'N', '--s1'), curve('tangential_force_N', 'tangential', 'N', '--s2')],
                       overlap: ['overlap [µm]', curve('overlap_um', 'overlap', 'µm', '--s3')],
                       contacts: ['contacts [-]', curve('contacts', 'contacts', '[-]', '--s4')] }[controls.quantity.value];
    return { traces: quantity.slice(1), layout: { xaxis: axis('time [s]'), yaxis: axis(quantity[0], controls.quantity.value === 'contacts' ? { rangemode: 'tozero' } : {}) },
             caption: `${ { force: 'Normal and tangential force between the loaded particle and the wall', overlap: 'Overlap of the loaded particle and the wall', contacts: 'Contacts between the loaded particle and the wall' }[controls.quantity.value]}, as recorded` + (thinned.force ? '; thinned for this page, tables/force.csv has all.' : '.') };
  }, 'force.csv', () => force.csv);
}

// ---------------------------------------------------------------- start
Charts.start(async () => {
  const facts = JSON.parse(await inflateText('data-facts'));
  counted = facts.counted;
  const data = {};
  for (const name of ['revolutions', 'contours', 'profiles', 'force']) data[name] = await table(name);
  const arrays = {}, steps = facts.surface;
  if (steps) {
    for (const name of ['x', 'y', 'z']) arrays[name] = await inflateNumbers(name, steps.position_step);
    for (const name of ['nx', 'ny', 'nz']) arrays[name] = await inflateNumbers(name, steps.normal_step);
    for (const name of ['depth', 'map']) arrays[name] = await inflateNumbers(name, steps.depth_step);
    for (const name of ['i', 'j', 'k']) arrays[name] = await inflateNumbers(name, 1);
  }
  surfaceFigure(data, facts, arrays);
  volumeFigure(data, facts);
  const map = facts.wear_map;
  if (map) {
    const parts = {};
    for (const name of ['x', 'y', 'z']) parts[name] = await inflateNumbers(`wm-${name}`, map.position_step);
    for (const name of ['i', 'j', 'k']) parts[name] = await inflateNumbers(`wm-${name}`, 1);
    for (const { key, step } of map.quantities) parts[key] = await inflateNumbers(`wm-${key}`, step);
    wearMapFigure(map, parts);
  }
  if (!document.getElementById('h-groove')) return;  // particles in numbers make no groove
  profileFigure(data, facts);
  spreadFigure('fig-depth-spread', data, { column: 'depth_mm', factor: 1000, unit: 'µm', noun: 'depth', test: 'depth_p_chi2', color: '--s1' });
  spreadFigure('fig-width-spread', data, { column: 'width_mm', factor: 1, unit: 'mm', noun: 'width', test: 'width_p_chi2', color: '--s1' });
  growthFigure('fig-depth-growth', data, { mean: 'depth_mean_mm', sd: 'depth_sd_mm', low: 'depth_min_mm', high: 'depth_max_mm', factor: 1000, unit: 'µm', noun: 'depth', range: facts.measured.depth_um });
  growthFigure('fig-width-growth', data, { mean: 'width_mean_mm', sd: 'width_sd_mm', factor: 1, unit: 'mm', noun: 'width', range: facts.measured.width_mm });
  boxFigure(data);
  forceFigure(data, facts);
});
})();
