// SPDX-License-Identifier: BSD-3-Clause
// make_picture.mjs CHROMIUM REPORT.html PICTURE.png: the worn disc in 3D above the contours of its groove, as the
// report draws them, without the page around them. Called by make_picture.sh.
import { readFileSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from '../tests/report/browser.mjs';

const [chromium, report, picture] = process.argv.slice(2);
const kWidth = 1040, kSurfaceHeight = 430, kProfilesHeight = 270;
const browser = await launch(chromium);
try {
  await browser.resize(kWidth, 900, false);
  await browser.send('Page.navigate', { url: pathToFileURL(resolve(report)).href });
  await browser.until('document.documentElement?.dataset.ready', 120);
  if (await browser.evaluate('document.documentElement.dataset.ready') !== 'yes') throw new Error('the report did not draw');
  // The two figures' plots alone, one above the other, redrawn at the picture's size.
  const height = await browser.evaluate(`(async () => {
    const style = document.createElement('style');
    style.textContent = '.modebar { display: none !important }';
    document.head.append(style);
    const stage = document.createElement('div');
    stage.style = 'position: absolute; left: 0; top: 0; width: ${kWidth}px; background: white; z-index: 9';
    for (const [id, height] of [['surface', ${kSurfaceHeight}], ['profiles', ${kProfilesHeight}]]) {
      const plot = document.querySelector('#fig-' + id + ' .plot');
      plot.style = 'width: ${kWidth}px; height: ' + height + 'px; min-height: 0; max-height: none';
      stage.append(plot);
      await Plotly.relayout(plot, { width: ${kWidth}, height, paper_bgcolor: 'white', plot_bgcolor: 'white' });
    }
    document.body.replaceChildren(stage);
    const surface = stage.firstChild;
    await Plotly.relayout(surface, { 'scene.camera.eye': { x: 0, y: -0.86, z: 0.82 }, 'scene.camera.center': { x: 0, y: -0.05, z: -0.12 } });
    await new Promise((done) => setTimeout(done, 1500));
    return stage.getBoundingClientRect().height;
  })()`);
  const { data } = await browser.send('Page.captureScreenshot', { format: 'png', captureBeyondViewport: true,
    clip: { x: 0, y: 0, width: kWidth, height, scale: 1 } });
  writeFileSync(picture, Buffer.from(data, 'base64'));
  console.log(`${picture}: ${readFileSync(picture).length} bytes`);
} finally {
  await browser.close();
}
