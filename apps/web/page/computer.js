// SPDX-License-Identifier: Apache-2.0
// How many cameras this computer decodes and draws, measured for about a second with pictures that are made here: a hilly
// depth picture and a coloured one of the usual sizes, drawn as a grid as the room's are.

const depth_size = [640, 576], color_size = [1280, 720];
const pictures_per_s = 30, passes = 5, longest_ms = 700;
const drawn_per_s = { card: 30, processor: 5 };   // of the room, by what draws it
const drawn_step = { card: 1, processor: 2 };     // pixels between two points of the grid
const free_share = { card: 0.7, processor: 0.4 }; // of the processors, for decoding
export const most_cameras = 6;

// `time_depth(width, height, passes)` decodes a depth picture and returns milliseconds; below 0: it cannot. `graphics` as
// find_graphics() says, `workers`: that decode. Returns milliseconds of a camera's picture each, and how many cameras are smooth.
export async function measure_computer({ time_depth, graphics, workers, signal }) {
    const depth_ms = time_depth(...depth_size, passes);
    await rest(signal);
    const color_ms = await time_color(signal);
    const draw_ms = graphics === "none" ? Infinity : await time_drawing(drawn_step[graphics], signal);
    return { depth_ms, color_ms, draw_ms, cameras: count_cameras({ depth_ms, color_ms, draw_ms, graphics, workers }) };
}

// The slower of decoding and drawing decides.
export function count_cameras({ depth_ms, color_ms, draw_ms, graphics, workers }) {
    if (graphics === "none" || depth_ms < 0)
        return 0;
    const decoded = free_share[graphics] * Math.max(workers, 1) * 1000 / pictures_per_s / (depth_ms + color_ms);
    const drawn = 1000 / drawn_per_s[graphics] / draw_ms;
    return Math.min(most_cameras, Math.floor(Math.min(decoded, drawn)));
}

// [key, values] of the sentence.
export function judge_computer({ cameras, graphics }) {
    const key = graphics === "none" ? "computer_flat" : cameras === 0 ? "computer_slow" : cameras === 1 ? "computer_one"
        : cameras >= most_cameras ? "computer_most" : "computer_many";
    return [key, { count: cameras }];
}

// The page stays alive meanwhile, and a dialog that was closed ends it.
async function rest(signal) {
    await new Promise(soon => setTimeout(soon));
    signal.throwIfAborted();
}

const median = all => [...all].sort((a, b) => a - b)[all.length >> 1];

async function times_of(act, signal) {
    const first_ms = performance.now();
    await act();  // also makes what the others have
    const times = [performance.now() - first_ms], end_ms = performance.now() + longest_ms;
    while (times.length < passes && performance.now() < end_ms) {
        const begin = performance.now();
        await act();
        times.push(performance.now() - begin);
        await rest(signal);
    }
    return median(times.length > 1 ? times.slice(1) : times);
}

// Fixed, so that two computers have the same to do.
function random_of(seed) {
    return () => (seed = (seed * 48271) % 2147483647) / 2147483647;
}

function paint(canvas) {
    const to = canvas.getContext("2d"), random = random_of(7);
    for (let i = 0; i < 2000; ++i) {
        to.fillStyle = `rgb(${[0, 1, 2].map(() => Math.floor(256 * random())).join()})`;
        to.fillRect(random() * canvas.width, random() * canvas.height, 60 * random(), 60 * random());
    }
}

function canvas_of([width, height]) {
    return Object.assign(document.createElement("canvas"), { width, height });
}

async function time_color(signal) {
    const canvas = canvas_of(color_size);
    paint(canvas);
    const picture = await new Promise(done => canvas.toBlob(done, "image/jpeg", 0.85));
    return times_of(async () => (await createImageBitmap(picture)).close(), signal);
}

const vertex_source = `#version 300 es
precision highp float;
precision highp usampler2D;
uniform usampler2D depth;
uniform int step_px;
out vec2 at;
out float far;
void main() {
    ivec2 size = textureSize(depth, 0);
    int columns = (size.x - 1) / step_px + 1;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns) * step_px;
    far = float(texelFetch(depth, pixel, 0).r) * 0.001;
    at = (vec2(pixel) + 0.5) / vec2(size);
    gl_Position = vec4((2.0 * at - 1.0) * vec2(1.0, -1.0) * far * 0.9, far * 0.1, far);
}`;
const fragment_source = `#version 300 es
precision highp float;
uniform sampler2D color;
in vec2 at;
in float far;
out vec4 drawn;
void main() { drawn = vec4(texture(color, at).rgb * (1.2 - 0.1 * far), 1.0); }`;

function program_of(gl) {
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex_source], [gl.FRAGMENT_SHADER, fragment_source]]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
        throw new Error(gl.getProgramInfoLog(program));
    return program;
}

function texture_of(gl, unit, [width, height], format) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const parameter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, parameter, format === gl.R16UI ? gl.NEAREST : gl.LINEAR);
}

// Two triangles between each four points.
function grid_of(columns, rows) {
    const indices = new Uint32Array(6 * (columns - 1) * (rows - 1));
    let at = 0;
    for (let y = 0; y + 1 < rows; ++y)
        for (let x = 0; x + 1 < columns; ++x, at += 6) {
            const corner = y * columns + x;
            indices.set([corner, corner + 1, corner + columns, corner + 1, corner + columns + 1, corner + columns], at);
        }
    return indices;
}

function speckles([width, height]) {
    const made = new Uint8Array(4 * width * height);
    for (let i = 0; i < made.length; ++i)
        made[i] = i * 2654435761 >>> 24;
    return made;
}

function hills([width, height]) {
    return Uint16Array.from({ length: width * height }, (_, i) =>
        2000 + 600 * Math.sin(i % width / 60) + 400 * Math.cos(Math.floor(i / width) / 45));
}

// Milliseconds of one more camera in a picture of the page's size: its pictures are handed over and drawn.
async function time_drawing(step, signal) {
    const ratio = Math.min(devicePixelRatio, 2);
    const canvas = canvas_of([Math.round(innerWidth * ratio), Math.round(innerHeight * ratio)]);
    const gl = canvas.getContext("webgl2", { antialias: false });
    if (!gl)
        return Infinity;
    try {
        const program = program_of(gl), depth = hills(depth_size), color = speckles(color_size);
        gl.useProgram(program);
        texture_of(gl, 0, depth_size, gl.R16UI);
        texture_of(gl, 1, color_size, gl.RGBA8);
        for (const [name, unit] of [["depth", 0], ["color", 1]])
            gl.uniform1i(gl.getUniformLocation(program, name), unit);
        gl.uniform1i(gl.getUniformLocation(program, "step_px"), step);
        gl.enable(gl.DEPTH_TEST);
        const indices = grid_of(...depth_size.map(side => Math.floor((side - 1) / step) + 1));
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        const draw = cameras => {
            gl.viewport(0, 0, canvas.width, canvas.height);
            gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
            for (let i = 0; i < cameras; ++i) {
                gl.activeTexture(gl.TEXTURE0);
                gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ...depth_size, gl.RED_INTEGER, gl.UNSIGNED_SHORT, depth);
                gl.activeTexture(gl.TEXTURE1);
                gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ...color_size, gl.RGBA, gl.UNSIGNED_BYTE, color);
                gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
            }
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits until it is drawn
        };
        const one_ms = await times_of(() => draw(1), signal), two_ms = await times_of(() => draw(2), signal);
        return Math.max(two_ms - one_ms, two_ms / 4);  // times are rounded where the browser wants it
    } finally {
        gl.getExtension("WEBGL_lose_context")?.loseContext();
    }
}
