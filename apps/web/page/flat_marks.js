// SPDX-License-Identifier: Apache-2.0
// Lines and labels of people over the 2D view's picture, as viewer/flat/flat_drawing.h gives them. They look as in the room
// (src/render/scene_lines.h): a least width, an outline, labels on plates.

const line_share = 0.0045, least_line_px = 4, outline_part = 0.4, least_outline_px = 1.5;  // shares of the smaller side
const letter_share = 0.0165, least_letter_px = 11;  // capital letters
const capitals = 0.72;  // of a font's size
const plate = "rgba(16, 18, 22, 0.85)", edge_px = 2, padding = 0.6, apart = 1.2;
const ranks = { author: 0 };
const small_px = 520;  // a narrower picture has short labels

// The part of an element that shows a picture of this size (object-fit: contain), in pixels of the page.
export function picture_box({ clientWidth, clientHeight, width, height }) {
    const scale = Math.min(clientWidth / width, clientHeight / height);
    return { left: (clientWidth - width * scale) / 2, top: (clientHeight - height * scale) / 2, width: width * scale, height: height * scale };
}

export class FlatMarks {
    drawing = { lines: [], labels: [] };

    // `canvas` lies over `picture`, a canvas too.
    constructor(canvas, picture) {
        Object.assign(this, { canvas, picture, drawn: "" });
    }

    // Once per step of the page. `news`: JSON, or "" for what was drawn last.
    draw(news) {
        if (news)
            this.drawing = JSON.parse(news);
        const { canvas, picture } = this;
        if (picture.width <= 1)
            return this.clear();
        const ratio = Math.min(devicePixelRatio, 2), box = picture_box(picture);
        const size = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
        const place = [box.left, box.top, ...size].join(" ");
        if (!news && place === this.drawn)
            return;
        this.drawn = place;
        Object.assign(canvas.style, { left: `${box.left}px`, top: `${box.top}px`, width: `${box.width}px`, height: `${box.height}px` });
        [canvas.width, canvas.height] = size;
        const is_small = box.width < small_px;
        const shown = paint(canvas.getContext("2d"), size, ratio, this.drawing, is_small);
        canvas.dataset.labels = shown.join("; ");
    }

    // There is no picture.
    clear() {
        this.canvas.width = this.canvas.height = 1;
        this.drawn = "";
    }

    // The picture with all that lies over it, at the picture's own size.
    copy() {
        const { width, height } = this.picture, copy = document.createElement("canvas");
        Object.assign(copy, { width, height });
        const to = copy.getContext("2d");
        to.drawImage(this.picture, 0, 0);
        paint(to, [width, height], 1, this.drawing);
        return copy;
    }
}

// `ratio`: pixels of the canvas for one of the page. Returns the labels that are shown.
function paint(to, [width, height], ratio, { lines, labels }, is_small = false) {
    const smaller = Math.min(width, height);
    const least = Math.max(least_line_px * ratio, line_share * smaller) / 2;
    const around = Math.max(least_outline_px * ratio, outline_part * 2 * least);
    to.lineCap = to.lineJoin = "round";
    const paint_lines = chosen => {
        for (const { color, outline, pieces } of chosen)
            // First around all pieces, so that no piece's outline covers its neighbour.
            for (const [paint_color, more] of [[outline, around], [color, 0]]) {
                to.fillStyle = to.strokeStyle = paint_color;
                for (const [x0, y0, r0, n0, x1, y1, r1, n1] of pieces)
                    paint_piece(to, { x: x0 * width, y: y0 * height, half: Math.max(r0 * height, n0 * least) },
                                { x: x1 * width, y: y1 * height, half: Math.max(r1 * height, n1 * least) }, more);
            }
    };
    paint_lines(lines.filter(({ points }) => !points));
    const letter = Math.max(least_letter_px * ratio, letter_share * smaller);
    const shown = paint_labels(to, [width, height], letter, labels, is_small);
    // No label hides where somebody points.
    paint_lines(lines.filter(({ points }) => points));
    return shown;
}

function paint_piece(to, from, end, more) {
    to.beginPath();
    if (from.x === end.x && from.y === end.y) {
        to.arc(from.x, from.y, from.half + more, 0, 2 * Math.PI);
        return to.fill();
    }
    if (end.half > 0) {
        to.lineWidth = 2 * (from.half + more);
        to.moveTo(from.x, from.y);
        to.lineTo(end.x, end.y);
        return to.stroke();
    }
    // The tip of an arrow: at least as long as it is wide.
    const length = Math.hypot(end.x - from.x, end.y - from.y);
    const [ax, ay] = [(end.x - from.x) / length, (end.y - from.y) / length];
    const back = Math.max(length, 2 * from.half), [bx, by] = [end.x - ax * back, end.y - ay * back];
    to.moveTo(end.x, end.y);
    to.lineTo(bx - ay * from.half, by + ax * from.half);
    to.lineTo(bx + ay * from.half, by - ax * from.half);
    to.closePath();
    to.fill();
    if (more) {
        to.lineWidth = 2 * more;
        to.stroke();
    }
}

// No plate covers another one; an author's initials make room.
function paint_labels(to, size, letter, labels, is_small) {
    to.font = `${letter / capitals}px system-ui, sans-serif`;
    to.textBaseline = "middle";
    const plates = [];
    for (const { text: whole, brief, x, y, color, rank } of [...labels].sort((a, b) => b.rank - a.rank)) {
        const text = is_small ? brief : whole;
        const at = [x * size[0], y * size[1]], far = apart * letter;
        const plate_size = [to.measureText(text).width + 2 * padding * letter, letter * (1 + 2 * padding)];
        const box = free_place(at, plate_size, far, size, plates);
        if (box || rank !== ranks.author)
            plates.push({ ...(box ?? place_beside(at, plate_size, far, size, 1, -1)), text, color, at });
    }
    // A label that had to go away from its place is joined to it.
    for (const { left, top, wide, high, color, at: [x, y] } of plates) {
        const near = [Math.max(left, Math.min(x, left + wide)), Math.max(top, Math.min(y, top + high))];
        if (Math.hypot(near[0] - x, near[1] - y) < 2 * apart * letter)
            continue;
        to.strokeStyle = color;
        to.lineWidth = Math.max(edge_px, letter / 6);
        to.beginPath();
        to.moveTo(x, y);
        to.lineTo(...near);
        to.stroke();
    }
    for (const { left, top, wide, high, text, color } of plates.reverse()) {
        to.fillStyle = plate;
        to.strokeStyle = color;
        to.lineWidth = Math.max(edge_px, letter / 6);
        to.beginPath();
        to.roundRect(left, top, wide, high, letter / 3);
        to.fill();
        to.stroke();
        to.fillStyle = "white";
        to.fillText(text, left + padding * letter, top + high / 2);
    }
    return plates.map(({ text }) => text);
}

function place_beside([x, y], [wide, high], far, [width, height], right, below) {
    const within = (value, most) => Math.max(0, Math.min(value, most));
    return { left: within(right > 0 ? x + far : x - far - wide, width - wide), top: within(below > 0 ? y + far : y - far - high, height - high),
             wide, high };
}

function free_place(at, size, far, area, plates) {
    const covers = (a, b) => a.left < b.left + b.wide && b.left < a.left + a.wide && a.top < b.top + b.high && b.top < a.top + a.high;
    for (const times of [1, 3, 5])
        for (const [right, below] of [[1, -1], [-1, -1], [1, 1], [-1, 1]]) {
            const box = place_beside(at, size, far * times, area, right, below);
            const hides = at[0] >= box.left && at[0] <= box.left + box.wide && at[1] >= box.top && at[1] <= box.top + box.high;
            if (!hides && !plates.some(other => covers(box, other)))
                return box;
        }
    return null;
}
