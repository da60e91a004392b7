// SPDX-License-Identifier: Apache-2.0
#include "compare_page_parts.h"

namespace theatron::bench {

// Below 64rem the table is a list: each figure has a line, with the name of its way before it, so
// that no title of a column has to stay in view.
const char* compare_page_head() {
    return R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Theatron beside a video call</title>
<style>
:root { --text: #1c1c1c; --quiet: #555; --page: #fff; --part: #eef2f7; --line: #ccc; --ours: #1f5fa8; --tint: #e9f1fa; }
@media screen and (prefers-color-scheme: dark) {
:root { --text: #e8e8e8; --quiet: #b4b4b4; --page: #16181b; --part: #262b32; --line: #4a4f57; --ours: #79b1f2; --tint: #1c2b3d; }
}
body { font: 16px/1.5 sans-serif; color: var(--text); background: var(--page); margin: 0 auto; padding: 1.5rem; max-width: 72rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin-top: 0; }
h2 { font-size: 1.25rem; margin-top: 2.2rem; }
.lead { font-size: 1.1rem; }
.quiet, small { color: var(--quiet); }
.verdict { border: 3px solid var(--ours); padding: .6rem 1rem; margin-bottom: 1.2rem; }
.verdict h2 { font-size: 1.25rem; margin: 0; }
.verdict ul { margin: .3rem 0 0; padding-left: 1.2rem; }
.verdict li:first-child { font-weight: bold; }
.limits { border-left: 4px solid var(--ours); background: var(--part); padding: .6rem 1rem; }
.limits h2 { font-size: 1rem; margin: 0; }
.limits ul { margin: .3rem 0 0; padding-left: 1.2rem; }
dt { font-weight: bold; margin-top: .6rem; }
dd { margin-left: 0; }
.pictures { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 1.2rem; }
.pictures.pairs { grid-template-columns: repeat(2, minmax(0, 1fr)); }
@media (max-width: 60rem) { .pictures { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media (max-width: 42rem) { .pictures, .pictures.pairs { grid-template-columns: minmax(0, 1fr); } }
figure { margin: 0; }
figure button { display: block; width: 100%; padding: 0; border: 1px solid var(--line); background: none; cursor: zoom-in; }
figure.ours button { border: 3px solid var(--ours); }
figure img { width: 100%; aspect-ratio: 16 / 9; object-fit: contain; background: #202226; display: block; }
button:focus-visible { outline: 4px solid var(--ours); outline-offset: 2px; }
figcaption { margin-top: .35rem; line-height: 1.4; }
figcaption small { display: block; }
dialog { inset: 0; width: 100%; height: 100%; max-width: none; max-height: none; margin: 0; padding: 0; border: 0; box-sizing: border-box; background: var(--page); color: var(--text); }
dialog[open] { display: flex; flex-direction: column; }
dialog .frame { flex: 1; min-height: 0; overflow: auto; }
dialog img { display: block; margin: auto; width: 100%; height: 100%; object-fit: contain; cursor: zoom-in; }
dialog img.larger { width: max(150%, 60rem); height: auto; cursor: zoom-out; }
dialog .below { padding: .5rem 1rem; display: flex; gap: .6rem; align-items: center; flex-wrap: wrap; }
dialog .text { flex: 1 1 22rem; }
dialog .text small { display: block; }
dialog .below button { font: inherit; min-width: 2.8rem; min-height: 2.8rem; color: inherit; background: var(--part); border: 1px solid var(--line); border-radius: .4rem; }
table { border-collapse: collapse; table-layout: fixed; width: 100%; font-size: .95rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .6rem; border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
thead th { position: sticky; top: 0; background: var(--page); border-bottom: 2px solid var(--quiet); }
thead th:first-child { width: 22%; }
tbody th { font-weight: normal; }
th small, td small { display: block; }
.list { display: none; }
td.ours, thead th.ours { background: var(--tint); }
tr.part th { font-weight: bold; background: var(--part); }
@media screen and (max-width: 64rem) {
body { padding: 1rem; }
table, tbody, tr { display: block; }
thead { display: none; }
tr { border-bottom: 1px solid var(--line); padding-bottom: .3rem; }
tbody th { display: block; border-bottom: 0; padding: .5rem .3rem .1rem; font-weight: bold; }
tbody th small { font-weight: normal; }
td { display: grid; grid-template-columns: 45% 1fr; border-bottom: 0; padding: .1rem .3rem; }
td::before { content: attr(data-way); grid-row: span 2; }
td small { grid-column: 2; }
td.none { display: none; }
.list { display: block; }
}
@page { size: A4; margin: 14mm; }
@media print {
body { font-size: 10pt; max-width: none; padding: 0; }
.pictures { grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 4mm; }
.pictures.pairs { grid-template-columns: repeat(2, minmax(0, 1fr)); }
figure, tr, li, dt, dd, .limits, .verdict { break-inside: avoid; }
h2, dt { break-after: avoid; }
thead th { position: static; }
table { font-size: 9pt; }
.screen { display: none; }
}
</style>
</head>
<body>
)";
}

// Arrow keys and buttons step through the pictures of the same row, at the same size and place.
const char* compare_page_end() {
    return R"(<dialog aria-label="Picture">
<div class="frame"><img alt=""></div>
<div class="below"><div class="text"></div><button type="button" aria-label="Picture before">&#8249;</button><button type="button" aria-label="Next picture">&#8250;</button><button type="button" autofocus>Close</button></div>
</dialog>
<script>
const dialog = document.querySelector('dialog'), frame = dialog.querySelector('.frame');
const large = dialog.querySelector('img'), text = dialog.querySelector('.text');
const [before, next, close] = dialog.querySelectorAll('button');
let row = [], shown = 0;
function show(index) {
  shown = (index + row.length) % row.length;
  const small = row[shown].querySelector('img');
  large.src = small.src;
  large.alt = small.alt;
  text.innerHTML = row[shown].querySelector('figcaption').innerHTML;
}
for (const figure of document.querySelectorAll('figure'))
  figure.querySelector('button').onclick = () => {
    row = [...figure.parentElement.children];
    show(row.indexOf(figure));
    large.classList.remove('larger');
    dialog.showModal();
  };
// The whole picture first; a click or a tap on it enlarges the place that was touched.
large.onclick = (event) => {
  const box = large.getBoundingClientRect();
  const across = (event.clientX - box.left) / box.width, down = (event.clientY - box.top) / box.height;
  large.classList.toggle('larger');
  frame.scrollLeft = across * frame.scrollWidth - frame.clientWidth / 2;
  frame.scrollTop = down * frame.scrollHeight - frame.clientHeight / 2;
};
before.onclick = () => show(shown - 1);
next.onclick = () => show(shown + 1);
close.onclick = () => dialog.close();
dialog.onkeydown = (event) => {
  if (event.key === 'ArrowLeft') show(shown - 1);
  if (event.key === 'ArrowRight') show(shown + 1);
};
</script>
</body>
</html>
)";
}

}  // namespace theatron::bench
