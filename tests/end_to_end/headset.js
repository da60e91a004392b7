// SPDX-License-Identifier: Apache-2.0
// A simulated headset in the page, after iwer: it has a framebuffer of its own as real ones do, which the
// canvas then shows, and keeps what tests look at.
const device = new IWER.XRDevice(IWER.metaQuest3, { ipd: 0.064 });
device.stereoEnabled = true;
device.installRuntime({ forceInstall: true });

// Layers of one context share a framebuffer of the canvas's size.
const targets = new WeakMap();
function target_of(gl) {
    const { width, height } = gl.canvas;
    let target = targets.get(gl);
    if (target?.width === width && target.height === height)
        return target;
    const bound = gl.getParameter(gl.FRAMEBUFFER_BINDING);
    target = { width, height, framebuffer: target?.framebuffer ?? gl.createFramebuffer() };
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    for (const [attachment, format] of [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]]) {
        const buffer = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, bound);
    targets.set(gl, target);
    return target;
}
Object.defineProperty(XRWebGLLayer.prototype, "framebuffer", { get() { return target_of(this.context).framebuffer; } });

const headset = globalThis.simulated_headset = { device, frames: 0 };

// After the page's frame: shows the eyes on the canvas; keeps the pixels if asked to.
function show(gl) {
    const { framebuffer, width, height } = target_of(gl);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer);
    if (headset.wants_pixels) {
        const pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        headset.pixels = { width, height, pixels };
        headset.wants_pixels = false;
    }
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    ++headset.frames;
}

const request = XRSession.prototype.requestAnimationFrame;
XRSession.prototype.requestAnimationFrame = function (callback) {
    return request.call(this, (time, frame) => {
        callback(time, frame);
        const left = [...frame.session.inputSources].find(source => source.handedness === "left");
        headset.left_grip = left && frame.getPose(left.gripSpace, theatron.headset.space)?.transform.position;
        if (frame.session.renderState.baseLayer)
            show(frame.session.renderState.baseLayer.context);
    });
};

// The runtime moves its space: the head is over its origin then, and looks along -z. `is_known`: the event says how.
const make_space = XRSession.prototype.requestReferenceSpace;
XRSession.prototype.requestReferenceSpace = async function (type) {
    const space = await make_space.call(this, type);
    space.addEventListener("reset", event => event.transform = headset.space_moved);  // before the page's listener
    return space;
};
headset.recentre = is_known => {
    const { position, quaternion } = device;
    const yaw = 2 * Math.atan2(quaternion.y, quaternion.w);
    headset.space_moved = is_known ? new XRRigidTransform({ x: position.x, y: 0, z: position.z },
                                                          { x: 0, y: Math.sin(yaw / 2), z: 0, w: Math.cos(yaw / 2) }) : undefined;
    device.recenter();
};
headset.look = (x, y, z, yaw) => {
    device.position.set(x, y, z);
    device.quaternion.set(0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2));
};

// Head, controllers and hands as they are at first.
const inputs = ["left", "right"].flatMap(side => [device.controllers[side], device.hands[side]]);
const first = [device, ...inputs].map(({ position: p, quaternion: q }) => [[p.x, p.y, p.z], [q.x, q.y, q.z, q.w]]);
headset.rest = () => [device, ...inputs].forEach(({ position, quaternion }, i) => {
    position.set(...first[i][0]);
    quaternion.set(...first[i][1]);
});

// The page's wishes to the display, and what it sets of a layer that can have fewer pixels at the sides.
XRWebGLLayer.prototype.fixedFoveation = 0;
headset.asked = { rates: [], scales: [] };
const set_rate = XRSession.prototype.updateTargetFrameRate;
XRSession.prototype.updateTargetFrameRate = function (rate) {
    headset.asked.rates.push(rate);
    return set_rate.call(this, rate);
};
const set_scale = XRView.prototype.requestViewportScale;
XRView.prototype.requestViewportScale = function (scale) {
    headset.asked.scales.push([this.eye, scale]);
    return set_scale?.call(this, scale);
};

// Share of the pixels that hide the real world, of each half of the picture.
headset.opaque = async () => {
    headset.wants_pixels = true;
    while (headset.wants_pixels)
        await new Promise(done => setTimeout(done, 20));
    const { width, height, pixels } = headset.pixels;
    const halves = [0, 0];
    for (let i = 0; i < width * height; ++i)
        halves[i % width < width / 2 ? 0 : 1] += pixels[4 * i + 3] > 127 ? 1 : 0;
    return halves.map(count => count / (width * height / 2));
};

// A controller's or hand's ray from `from` through `to`, both in the tracking space.
headset.aim = (side, from, to) => {
    const input = device.primaryInputMode === "hand" ? device.hands[side] : device.controllers[side];
    const way = to.map((value, i) => value - from[i]);
    const length = Math.hypot(...way);
    const [x, y, z] = way.map(value => value / length);
    // The rotation that brings -z onto the way, by yaw about y and then pitch about x.
    const yaw = Math.atan2(-x, -z) / 2, pitch = Math.asin(y) / 2;
    input.position.set(...from);
    input.quaternion.set(Math.cos(yaw) * Math.sin(pitch), Math.sin(yaw) * Math.cos(pitch), -Math.sin(yaw) * Math.sin(pitch),
                         Math.cos(yaw) * Math.cos(pitch));
};

// The right ray onto a row of the menu at the left wrist (src/viewer/wrist_menu.h).
headset.aim_at_row = (row, rows) => {
    const { x, y, z } = headset.left_grip;
    headset.aim("right", [x + 0.1, y + 0.1, z + 0.3], [x, y + 0.06 + (rows - row - 0.5) * 0.03, z]);
};
// The right ray onto a row of the panels' plate, this far from its left edge (src/viewer/panels/plate.h). The plate came while
// the head was at rest.
headset.aim_at_plate = (row, at) => {
    const away = [-0.3, -0.7].map(way => way / Math.hypot(0.3, 0.7));
    const [x, y, z] = [-0.3 - away[1] * (at - 0.25), 1.65 - (row + 0.5) * 0.03, -0.7 + away[0] * (at - 0.25)];
    headset.aim("right", [x - 0.4 * away[0], y, z - 0.4 * away[1]], [x, y, z]);
};
headset.grip = (side, closed) => {
    if (device.primaryInputMode === "hand")
        device.hands[side].poseId = closed ? "pinch" : "default";
    else
        device.controllers[side].updateButtonValue("trigger", closed ? 1 : 0);
};

// Objects of GL that exist, by kind.
const objects = {};
for (const kind of ["Texture", "Buffer", "Framebuffer", "Renderbuffer", "VertexArray", "Program", "Shader", "Query"]) {
    const prototype = WebGL2RenderingContext.prototype;
    const make = prototype[`create${kind}`], remove = prototype[`delete${kind}`];
    objects[kind] = 0;
    prototype[`create${kind}`] = function (...all) {
        ++objects[kind];
        return make.apply(this, all);
    };
    prototype[`delete${kind}`] = function (object) {
        objects[kind] -= object ? 1 : 0;
        return remove.call(this, object);
    };
}
headset.objects = () => JSON.stringify(objects);
