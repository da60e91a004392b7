// SPDX-License-Identifier: Apache-2.0
// Packs the page for the host: node pack.mjs OUTPUT_FOLDER WEB_SOURCES MISSING FILE...
//
// All but pages (.html) get the hash of their content into their name, so that browsers may keep them for ever.
// Text and program are compressed in advance. files.txt has a line for each file: its path, type and name.
// WEB_SOURCES, the number of the page's sources, and MISSING, the libraries that it lacks, are copied.
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { basename, extname, join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

const types = {
    ".html": "text/html;charset=utf-8", ".css": "text/css;charset=utf-8", ".js": "text/javascript;charset=utf-8",
    ".mjs": "text/javascript;charset=utf-8", ".wasm": "application/wasm", ".svg": "image/svg+xml",
    ".txt": "text/plain;charset=utf-8",
};

const [folder, web_sources, missing, ...files] = process.argv.slice(2);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const paths = new Map(files.map(file => [basename(file), file]));
const stored = new Map();  // name -> name with its hash
const lines = [];

// Those that a file names come first: their hashes are part of its content. There is no circle.
function store(name) {
    if (stored.has(name))
        return stored.get(name);
    const ending = extname(name);
    let content = readFileSync(paths.get(name));
    if (ending !== ".wasm") {
        const text = content.toString("utf8").replace(/"(\.\/)?([\w.]+)"/g, (all, folder = "", other) =>
            other !== name && paths.has(other) ? `"${folder}${store(other)}"` : all);
        content = Buffer.from(text);
    }
    const hash = createHash("sha256").update(content).digest("hex").slice(0, 16);
    const bare = name.slice(0, -ending.length), is_page = ending === ".html";
    const as = is_page ? name : `${bare}.${hash}${ending}`;
    stored.set(name, as);
    writeFileSync(join(folder, as), content);
    writeFileSync(join(folder, as + ".gz"), gzipSync(content, { level: 9 }));
    writeFileSync(join(folder, as + ".br"), brotliCompressSync(content, {
        params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: content.length },
    }));
    lines.push(`/${name === "index.html" ? "" : is_page ? bare : as} ${types[ending]} ${as}`);
    return as;
}

for (const name of paths.keys())
    store(name);
copyFileSync(web_sources, join(folder, "web_sources.txt"));
copyFileSync(missing, join(folder, "missing.txt"));
// Last, and whole at once: a host that runs already begins to serve the page when this list is there.
writeFileSync(join(folder, "files.new"), lines.join("\n") + "\n");
renameSync(join(folder, "files.new"), join(folder, "files.txt"));
