// SPDX-License-Identifier: Apache-2.0
// Sends a message each time that the milliseconds of the only message to it have passed, also while the page is hidden.
onmessage = ({ data }) => setInterval(() => postMessage(null), data);
