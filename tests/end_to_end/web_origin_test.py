# SPDX-License-Identifier: Apache-2.0
"""A hostile page of another origin in the same browser: it reads nothing of the host, with a stolen token or without."""
import contextlib
import http.server
import json
import pathlib
import tempfile
import threading
import unittest

import theatron_process
from browser import CHROMIUM, Browser
from raw_peer import Link
from theatron_process import host

PAGE = pathlib.Path(theatron_process.PROGRAM).parent / "web/files.txt"

# Everything that a page can try with an address of another origin; what it got of each, null for nothing.
ATTACK = """(async (place, token, script, image) => {
    const https = `https://${place}`, got = {};
    const attempt = async (name, work) => {
        try {
            got[name] = await Promise.race([work(), new Promise(late => setTimeout(() => late("no answer"), 15000))]) ?? null;
        } catch {
            got[name] = null;
        }
    };
    const read = async (path, options) => {
        const answer = await fetch(https + path, options);
        return (await answer.text()) || (answer.type !== "opaque" && answer.status) || null;
    };
    for (const path of ["/", "/lobby", "/metrics", "/status"]) {
        await attempt(`fetch ${path}`, () => read(path));
        await attempt(`fetch ${path} with cookies`, () => read(path, { credentials: "include" }));
        await attempt(`fetch ${path} with the token`, () => read(path, { headers: { Authorization: `Bearer ${token}` } }));
        await attempt(`fetch ${path} opaquely`, () => read(path, { mode: "no-cors" }));
        await attempt(`post ${path}`, () => read(path, { method: "POST", mode: "no-cors", body: token }));
    }
    for (const path of ["/", "/connection", `/connection?join=${token}`])
        await attempt(`socket ${path}`, () => new Promise(done => {
            const socket = new WebSocket(`wss://${place}${path}`);
            socket.onopen = () => done("open");
            socket.onmessage = ({ data }) => done(data);
            socket.onerror = socket.onclose = () => done(null);
        }));
    const element = (name, kind, address) => attempt(name, () => new Promise(done => {
        const made = document.createElement(kind);
        made.onload = () => done("loaded");
        made.onerror = () => done(null);
        made.src = address;
        document.body.append(made);
    }));
    await element("script", "script", `${https}${script}`);
    await element("image", "img", `${https}${image}`);
    // A frame that is refused shows the browser's own page, of which nothing can be read.
    await attempt("frame", () => new Promise(done => {
        const frame = document.createElement("iframe");
        frame.onload = () => {
            try {
                done(frame.contentDocument?.body.innerText ?? frame.contentWindow.theatron);
            } catch {
                done(null);
            }
        };
        frame.src = `${https}/#join=${token}`;
        document.body.append(frame);
    }));
    await attempt("window", async () => {
        const other = open(`${https}/#join=${token}`);
        await new Promise(soon => setTimeout(soon, 3000));
        // Severed from this page, or at least unreadable.
        return other && !other.closed ? other.document.body.innerText : null;
    });
    return got;
})"""


class OnePage(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        body = b"<!doctype html><title>hostile</title><body>hostile</body>"
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


@unittest.skipUnless(CHROMIUM, "chromium is not installed: apt-get install chromium")
@unittest.skipUnless(PAGE.exists(), "there is no browser client: make build")
class OtherOrigin(unittest.TestCase):
    def test_it_reads_nothing_and_opens_nothing_though_the_person_is_in_the_session(self):
        with contextlib.ExitStack() as stack:
            folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
            h = stack.enter_context(host(folder / "host"))
            hostile = stack.enter_context(http.server.ThreadingHTTPServer(("127.0.0.1", 0), OnePage))
            threading.Thread(target=hostile.serve_forever, daemon=True).start()
            stack.callback(hostile.shutdown)
            browser = stack.enter_context(Browser("--disable-popup-blocking"))
            link = Link.parse(h.greeting["link"])
            place = f"127.0.0.1:{link.port}"

            # The person is in the session, in the same browser.
            own = browser.open(h.greeting["link"], (320, 180))
            own.enter(way="room")
            own.wait_for("theatron.state.phase === 'joined'")
            files = own.evaluate("[document.querySelector('script').src, document.querySelector('[rel=icon]').href]"
                                 ".map(file => new URL(file).pathname)")
            attack = f"{ATTACK}(...{json.dumps([place, link.token, *files])})"
            page = browser.open(f"http://127.0.0.1:{hostile.server_port}/", (320, 180))
            page.wait_for("document.title === 'hostile' && document.readyState === 'complete'")
            got = page.evaluate(attack)
            self.assertEqual({name: what for name, what in got.items() if what is not None}, {})
            self.assertEqual(own.evaluate("document.cookie"), "")
            self.assertEqual(own.evaluate("theatron.state.people.length"), 1)
            own.wait_for("theatron.state.phase === 'joined'")

            # The same attempts within the host's own origin do get something: the test would see it.
            allowed = own.evaluate(attack)
            for name in ("fetch /", "fetch /lobby with the token", "socket /connection", "script", "image"):
                self.assertIsNotNone(allowed[name], name)


if __name__ == "__main__":
    unittest.main()
