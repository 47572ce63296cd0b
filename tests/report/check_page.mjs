// SPDX-License-Identifier: BSD-3-Clause
// check_page.mjs <chromium> <report.html>: the page of make_page.cpp as its readers see it; fails, saying why.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { visit } from './visit.mjs';

const [chromium, file] = process.argv.slice(2);
const page = await visit(chromium, file), { browser, check } = page;
const kFigures = 6;  // a seventh has no data and says so
const count = (selector) => browser.evaluate(`document.querySelectorAll('${selector}').length`);

try {
  await page.open(1280, false, kFigures);
  check(await count('#fig-mesh_size .scatterlayer .trace') === 7, 'mesh_size: a series is missing');
  check(await count('#fig-forces .boxlayer path.box') === 24, 'forces: not 12 boxes in each of 2 series');
  check(await count('#fig-spread .barlayer .point') === 6 * 21, 'spread: bars are missing');
  check(await count('#fig-mesh_size .legendtext') === 5, 'mesh_size: a name of two panels must stand once in the legend');
  // Thinning keeps the one sample of 9 N among 100 000.
  check(await browser.evaluate('Math.max(...document.querySelector("#fig-trace .plot").data[0].y)') === 9, 'trace: the spike was thinned away');
  check((await browser.evaluate('document.querySelector("#fig-trace figcaption").textContent')).includes('of 100\u202f000 points; tables/trace.csv has all'), 'trace: the caption does not say that it is thinned');
  // NaN is a gap, in markers and in bands.
  check(await browser.evaluate('[...document.querySelector("#fig-mesh_size .plot").data.find(({ name }) => name.startsWith("per triangle")).y].filter(Number.isNaN).length') === 1, 'mesh_size: NaN is not a gap');
  check((await browser.evaluate('document.querySelector("#fig-mesh_size .plot").data.filter(({ fill }) => fill === "toself").map(({ x }) => [...x].filter((v) => v === null).length).join()')) === '1,2', 'mesh_size: a gap splits the band in two');
  check((await browser.evaluate('document.querySelector("#fig-disc figcaption").textContent')).includes('times too large'), 'disc: the exaggeration is not stated');
  // Badges are told apart by their words and signs.
  check((await browser.evaluate('[...document.querySelectorAll("#table-claims .mark")].map((m) => m.textContent).join()')) === '✓ reproduced,≈ trend only,✗ not reproduced,not answered', 'the badges are not readable');
  // What is saved: the data of a figure, of a table as in the file, pictures.
  const trace = (await page.save('#fig-trace a.csv', 'trace.csv')).toString();
  check(trace.startsWith('panel,series,time_s,force_N\n1,force <N>,0,5\n'), `trace.csv begins '${trace.slice(0, 60)}'`);
  const claims = (await page.save('#table-claims a.csv', 'claims.csv')).toString();
  check(claims === readFileSync(join(dirname(file), 'tables/claims.csv'), 'utf8'), `claims.csv is another than the file: ${claims}`);
  const svg = (await page.save('#fig-mesh_size .links button', 'mesh_size.svg')).toString();
  check(svg.startsWith('<svg') && svg.includes('wear depth [µm]') && !svg.includes('NaN'), 'the SVG of mesh_size is none');
  const png = await page.save('#fig-disc .links button:last-child', 'disc.png');
  check(png.subarray(1, 4).toString() === 'PNG' && png.readUInt32BE(16) === 2700, 'the PNG of disc is none, or not 2700 px wide');
  // A print must not wait for the reader to have seen every figure, nor break one over two sheets.
  await browser.send('Emulation.setEmulatedMedia', { media: 'print' });
  check(await browser.evaluate('[...document.querySelectorAll("figure")].every((f) => getComputedStyle(f).breakInside === "avoid")'), 'a figure may break over two sheets');
  check(await browser.evaluate('document.querySelector("#fig-disc img.on-paper").naturalWidth') === 2700, 'the view in 3D has no picture for paper');
  await browser.send('Emulation.setEmulatedMedia', { media: '' });
  const { pages, size } = await page.print();
  check(pages >= 4 && pages <= 9 && size > 150000, `printed: ${pages} pages, ${size} bytes`);
  await page.open(390, false, kFigures);
  await page.open(390, true, kFigures);
  check(page.dialogs === 0, 'text of the page ran as a script');
} catch (error) {
  page.failures.push(String(error));
}
await page.finish('Every kind of figure is complete at 1280 and 390 px and on paper, and loaded nothing.');
