// SPDX-License-Identifier: Apache-2.0
// Requests to the host by the token of a link. It stands in a header: in no address, referrer or cache.

export function ask_host(token, path, options) {
    return fetch(path, { headers: { Authorization: `Bearer ${token}` }, cache: "no-store", credentials: "omit", ...options });
}

// The picture of an answer, in its own size.
export async function draw_answer(canvas, answer) {
    const picture = await createImageBitmap(await answer.blob());
    Object.assign(canvas, { width: picture.width, height: picture.height });
    canvas.getContext("2d").drawImage(picture, 0, 0);
    picture.close();
}
