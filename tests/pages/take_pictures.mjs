// Takes the pictures of the tour: take_pictures.mjs FOLDER_OF_PAGES FOLDER_OF_PICTURES
import {writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {Browser} from './browser.mjs';

const [from, to] = process.argv.slice(2);
const browser = new Browser();
const dive = await browser.open(join(from, 'dive.html'), {width: 1100});
// what differs from machine to machine
await dive.evaluate(`for (const dt of document.querySelectorAll('.facts dt')) if (['On', 'Made by'].includes(dt.textContent)) { dt.nextSibling.remove(); dt.remove(); }`);
const part = async (page, name, first, last = first) => {
  const [top, bottom] = await page.evaluate(`[document.querySelector('${first}').getBoundingClientRect().top + scrollY, document.querySelector('${last}').getBoundingClientRect().bottom + scrollY]`);
  const {data} = await page.send('Page.captureScreenshot', {format: 'png', captureBeyondViewport: true, clip: {x: 0, y: top, width: 1100, height: bottom - top, scale: 0.72}});
  writeFileSync(join(to, name + '.png'), Buffer.from(data, 'base64'));
};
await part(dive, 'report', '.head', '#graph');
await part(dive, 'plots', '#plots .bench');
await part(dive, 'path', '#path .card');
const sea = await browser.open(join(from, 'sea.html'), {width: 1100});
await part(sea, 'campaign', '#histograms', '#scatter .grid');
await browser.close();
