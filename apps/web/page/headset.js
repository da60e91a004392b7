// SPDX-License-Identifier: Apache-2.0
// A headset by WebXR: its frames become numbers for the client (apps/web/headset_input.h), which draws both eyes.
import { put_bytes } from "./program.js";

// Pictures a second: the lowest rate at which turning the head is comfortable leaves the most time for each picture.
const usual_rate = 72;
const foveation = 0.5;  // 0: none, 1: most
const joints = ["wrist", "thumb-tip", "index-finger-tip", "middle-finger-tip", "ring-finger-tip"];
// Buttons and axes of the standard mapping "xr-standard".
const trigger = 0, squeeze = 1, lower_button = 4, upper_button = 5, stick = 2;
const near_m = 0.05, far_m = 100;  // as render::CameraView

// The kinds of session that this browser offers: {vr, ar}.
export async function headset_kinds() {
    const offered = async mode => {
        try {
            return await navigator.xr?.isSessionSupported(mode) ?? false;
        } catch {
            return false;  // a policy forbids it
        }
    };
    return { vr: await offered("immersive-vr"), ar: await offered("immersive-ar") };
}

// Poses in one reference space, as numbers.
class Numbers {
    constructor() {
        this.all = [];
    }
    put(...numbers) {
        this.all.push(...numbers);
    }
    pose({ position: p, orientation: q }) {
        this.put(p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    }
}

function put_hand(numbers, frame, space, source) {
    const aim = source && frame.getPose(source.targetRaySpace, space);
    const grip = source?.gripSpace && frame.getPose(source.gripSpace, space);
    if (!aim)
        return numbers.put(0);
    const places = source.hand && joints.map(name => frame.getJointPose(source.hand.get(name), space));
    const is_bare = Boolean(places?.every(Boolean));
    const { buttons = [], axes = [] } = source.gamepad ?? {};
    const value = button => buttons[button]?.value ?? 0;
    numbers.put(is_bare ? 2 : 1);
    numbers.pose(aim.transform);
    numbers.pose((grip ?? aim).transform);
    numbers.put(value(trigger), value(squeeze), axes[stick] ?? 0, axes[stick + 1] ?? 0, value(lower_button), value(upper_button));
    if (is_bare)
        for (const { transform: { position: p } } of places)
            numbers.put(p.x, p.y, p.z);
}

export class Headset {
    // `after_frame` is called after each picture, `ended` after each session.
    constructor({ canvas, module, client, after_frame, ended }) {
        Object.assign(this, { canvas, module, client, after_frame, ended, session: null, is_entering: false });
    }

    get is_on() {
        return this.session !== null;
    }

    // The page's state is shown as text in tests.
    toJSON() {
        return { is_on: this.is_on };
    }

    // From a click of the person. Throws an error with its reason.
    async enter(kind) {
        if (this.is_entering || this.session)
            return;
        this.is_entering = true;
        try {
            await this.begin(kind);
        } finally {
            this.is_entering = false;
        }
    }

    async begin(kind) {
        document.getElementById("headset_hint").hidden = true;
        const session = await navigator.xr.requestSession(`immersive-${kind}`, {
            requiredFeatures: ["local-floor"], optionalFeatures: ["hand-tracking"],
        });
        try {
            const gl = this.canvas.getContext("webgl2");
            await gl.makeXRCompatible();
            this.layer = new XRWebGLLayer(session, gl, { antialias: false, alpha: kind === "ar" });
            await session.updateRenderState({ baseLayer: this.layer, depthNear: near_m, depthFar: far_m });
            this.space = await session.requestReferenceSpace("local-floor");
            this.space.addEventListener("reset", ({ transform }) => this.move_space(transform));
            // Fewer pixels at the sides, where the headset can do that.
            if (typeof this.layer.fixedFoveation === "number")
                this.layer.fixedFoveation = foveation;
            const rates = [...session.supportedFrameRates ?? []].filter(rate => rate >= usual_rate);
            if (rates.length)
                await session.updateTargetFrameRate(Math.min(...rates)).catch(() => {});  // it keeps its own
        } catch (error) {
            await session.end().catch(() => {});
            throw error;
        }
        this.session = session;
        this.kind = kind;
        session.addEventListener("end", () => this.leave_session());
        this.client.enter_headset(kind === "ar" ? 1 : 0, session.frameRate ?? usual_rate);
        session.requestAnimationFrame((time, frame) => this.draw(time, frame));
    }

    // The space has another origin from the next frame on; `transform` may be missing.
    move_space(transform) {
        const numbers = new Numbers();
        if (transform)
            numbers.pose(transform);
        put_bytes(this.module, Float32Array.from(numbers.all).buffer);
        this.client.space_moved(transform ? 1 : 0);
    }

    async leave() {
        await this.session?.end();
    }

    leave_session() {
        this.session = null;
        this.module.headset_framebuffer = null;
        this.client.leave_headset();
        this.ended();
    }

    draw(time, frame) {
        if (!this.session)
            return;
        this.session.requestAnimationFrame((time, frame) => this.draw(time, frame));
        const viewer = frame.getViewerPose(this.space);
        if (!viewer)
            return;  // the head is not tracked: the headset shows the last picture or its own
        const numbers = new Numbers();
        // Browsers without a prediction say nothing of it.
        numbers.put(frame.predictedDisplayTime > 0 ? frame.predictedDisplayTime - performance.now() : 0);
        numbers.pose(viewer.transform);
        numbers.put(viewer.views.length);
        const scale = this.client.headset_scale();
        for (const view of viewer.views) {
            view.requestViewportScale?.(scale);
            const { x, y, width, height } = this.layer.getViewport(view);
            const m = view.projectionMatrix;
            numbers.put(x, y, width, height, m[0], m[5], m[8], m[9]);
            numbers.pose(view.transform);
        }
        const sources = [...this.session.inputSources];
        for (const side of ["left", "right"])
            put_hand(numbers, frame, this.space, sources.find(source =>
                source.handedness === side && source.targetRayMode === "tracked-pointer"));
        this.module.headset_framebuffer = this.layer.framebuffer;
        put_bytes(this.module, Float32Array.from(numbers.all).buffer);
        this.client.draw_headset(this.kind === "ar" ? 1 : 0);
        this.after_frame(time);
    }
}
