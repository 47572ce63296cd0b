// SPDX-License-Identifier: BSD-3-Clause
// make_picture.mjs CHROMIUM REPORT.html PICTURE.png: the worn disc in 3D above the contours of its groove, as the
// report draws them, without the page around them. Called by make_picture.sh.
import { readFileSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from '../tests/report/browser.mjs';

const [chromium, report, picture] = process.argv.slice(2);
const kWidth = 1040, kWhole = 470, kSurfaceHeight = 330, kProfilesHeight = 260;
const browser = await launch(chromium);
try {
  await browser.resize(kWidth, 900, false);
  await browser.send('Page.navigate', { url: pathToFileURL(resolve(report)).href });
  await browser.until('document.documentElement?.dataset.ready', 120);
  if (await browser.evaluate('document.documentElement.dataset.ready') !== 'yes') throw new Error('the report did not draw');
  // Copies of the report's figures at the picture's size: the whole track beside the close-up, the contours below.
  const height = await browser.evaluate(`(async () => {
    const stage = document.createElement('div');
    stage.style = 'position: absolute; left: 0; top: 0; width: ${kWidth}px; background: white; z-index: 9; display: flex; flex-wrap: wrap';
    document.body.append(stage);
    const hidden = (axis) => ({ ...axis, visible: false });
    const bare = (s) => ({ ...s, xaxis: hidden(s.xaxis), yaxis: hidden(s.yaxis), zaxis: hidden(s.zaxis) });
    async function copy(id, width, height, change) {
      const plot = document.querySelector('#fig-' + id + ' .plot'), place = document.createElement('div');
      const layout = { ...plot.layout, width, height, autosize: false, paper_bgcolor: 'white', plot_bgcolor: 'white' };
      const data = plot.data.map((trace) => ({ ...trace }));
      change(data, layout);
      stage.append(place);
      await Plotly.newPlot(place, data, layout, { displayModeBar: false });
    }
    await copy('surface', ${kWhole}, ${kSurfaceHeight}, (data, layout) => {
      data[0].showscale = false;
      layout.scene = { ...bare(layout.scene), camera: { eye: { x: 0, y: -1.15, z: 1.1 }, center: { x: 0, y: -.08, z: -.08 } } };
    });
    const view = document.querySelector('#fig-surface [data-control=view]'), plot = document.querySelector('#fig-surface .plot');
    const triangles = plot.data[0].i.length;
    view.value = 'close';
    view.dispatchEvent(new Event('change'));
    while (plot.data[0].i.length === triangles) await new Promise((done) => setTimeout(done, 100));
    await copy('surface', ${kWidth - kWhole}, ${kSurfaceHeight}, (data, layout) => { layout.scene = bare(layout.scene); });
    await copy('profiles', ${kWidth}, ${kProfilesHeight}, () => {});
    for (const child of [...document.body.children]) if (child !== stage) child.hidden = true;
    await new Promise((done) => setTimeout(done, 2000));
    return stage.getBoundingClientRect().height;
  })()`);
  const { data } = await browser.send('Page.captureScreenshot', { format: 'png', captureBeyondViewport: true,
    clip: { x: 0, y: 0, width: kWidth, height, scale: 1 } });
  writeFileSync(picture, Buffer.from(data, 'base64'));
  console.log(`${picture}: ${readFileSync(picture).length} bytes`);
} finally {
  await browser.close();
}
