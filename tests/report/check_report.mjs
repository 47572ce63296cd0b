// SPDX-License-Identifier: BSD-3-Clause
// check_report.mjs <chromium> <report.html> <figures>: a run's report as its readers see it; fails, saying why.
import { visit } from './visit.mjs';

const [chromium, file, wanted] = process.argv.slice(2);
const page = await visit(chromium, file), { browser, check } = page;
try {
  await page.open(1280, false, wanted);
  if (Number(wanted) > 0) {
    // The 3D view must show the groove: pixels of the deepest colour's blues, not a blank canvas.
    const { data } = await browser.send('Page.captureScreenshot', { format: 'png', clip: { ...await browser.evaluate(
      '(({ x, y, width, height }) => ({ x, y: y + scrollY, width: width * 0.8, height }))(document.querySelector("#fig-surface .plot").getBoundingClientRect())'), scale: 1 } });
    const dark = await browser.evaluate(`(async () => {
      const image = new Image();
      image.src = 'data:image/png;base64,${data}';
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext('2d', { willReadFrequently: true });
      pen.drawImage(image, 0, 0);
      const p = pen.getImageData(0, 0, image.width, image.height).data;
      let count = 0;
      for (let k = 0; k < p.length; k += 4) if (p[k + 2] > p[k] + 40 && p[k] < 110) ++count;
      return count;
    })()`);
    check(dark > 500, `the worn surface shows ${dark} pixels of worn metal, expected more than 500`);
    // Every control redraws its figure.
    for (const [figure, control, value] of [['surface', 'view', 'close'], ['surface', 'exaggeration', '10'], ['profiles', 'revolution', '1'], ['force', 'quantity', 'overlap']]) {
      const before = await browser.evaluate(`JSON.stringify([...document.querySelector('#fig-${figure} .plot').data].map((t) => [t.y.length, t.y[40], t.z?.length, t.z?.[40]])) + document.querySelector('#fig-${figure} .words').textContent`);
      await browser.evaluate(`(() => { const c = document.querySelector('#fig-${figure} [data-control=${control}]'); c.value = '${value}'; c.dispatchEvent(new Event('change')); })()`);
      await browser.until(`JSON.stringify([...document.querySelector('#fig-${figure} .plot').data].map((t) => [t.y.length, t.y[40], t.z?.length, t.z?.[40]])) + document.querySelector('#fig-${figure} .words').textContent !== ${JSON.stringify(before)}`, 60);
    }
    // The links save the table that the figure shows, and its picture.
    const csv = (await page.save('#fig-volume a.csv', 'revolutions.csv')).toString();
    check(csv.startsWith('revolution,time_s,law_volume_mm3,'), `the CSV of the volume begins '${csv.slice(0, 40)}'`);
    const svg = (await page.save('#fig-volume .links button', 'volume.svg')).toString();
    check(svg.startsWith('<svg') && svg.includes('wear volume [mm³]'), 'the SVG of the volume is none');
    const { pages, size } = await page.print();
    check(pages >= 5 && pages <= 15 && size > 100000, `printed: ${pages} pages, ${size} bytes`);
  }
  await page.open(390, false, wanted);
  await page.open(390, true, wanted);
  check(page.dialogs === 0, 'text of the case ran as a script');
} catch (error) {
  page.failures.push(String(error));
}
await page.finish('The report is complete at 1280 and 390 px and on paper, and loaded nothing.');
