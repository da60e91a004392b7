# SPDX-License-Identifier: Apache-2.0
"""Chromium without a window, driven by its DevTools protocol over a pipe: no further package is needed."""
import base64
import json
import os
import pathlib
import queue
import shutil
import signal
import subprocess
import tempfile
import threading

import patience

CHROMIUM = shutil.which("chromium")


class Browser:
    """One Chromium with a fresh profile. Certificates are not checked: hosts in tests make their own.
    `prefix`: words of a command that starts it."""

    def __init__(self, *options, prefix=()):
        self.profile = tempfile.TemporaryDirectory(prefix="theatron_browser_", ignore_cleanup_errors=True)
        child_reads, self.commands = os.pipe()
        self.answers, child_writes = os.pipe()
        # The protocol's pipes are the descriptors 3 and 4 of the browser.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{child_reads} 4>&{child_writes}', "bash", *prefix, CHROMIUM,
             "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
             "--use-angle=gles-egl", "--ignore-gpu-blocklist", "--ignore-certificate-errors",
             "--no-first-run", "--disable-background-networking",
             # The software driver takes and gives back the same memory many times a picture: it stays at the process.
             "--enable-features=PartitionAllocLargeEmptySlotSpanRing",
             # A test's clicks by script are no gestures of a person.
             "--autoplay-policy=no-user-gesture-required", "--lang=en-US",
             "--remote-debugging-pipe", f"--user-data-dir={self.profile.name}", *options, "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=(child_reads, child_writes),
            start_new_session=True)
        os.close(child_reads)
        os.close(child_writes)
        self.next_id = 0
        self.lock = threading.Lock()
        self.waiting = {}
        self.pages = {}
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        patience.watch(self)

    def _read(self):
        rest = b""
        while data := os.read(self.answers, 1 << 20):
            *messages, rest = (rest + data).split(b"\0")
            for message in messages:
                message = json.loads(message)
                if "id" in message:
                    self.waiting.pop(message["id"]).put(message)
                elif page := self.pages.get(message.get("sessionId")):
                    page.on_event(message["method"], message["params"])

    def has_ended(self):
        return self.process.poll() is not None

    def counted(self):
        return sum(page.events for page in list(self.pages.values()))

    def crashed(self):
        return self.has_ended()

    def last_words(self):
        return f"browser ({'ended' if self.has_ended() else 'runs'}): " + \
            "; ".join(f"{page.url.split('#')[0]} {page.problems[-5:]}" for page in list(self.pages.values()))

    def call(self, method, session=None, **parameters):
        answer = queue.Queue()
        with self.lock:
            self.next_id += 1
            message = {"id": self.next_id, "method": method, "params": parameters}
            if session:
                message["sessionId"] = session
            self.waiting[self.next_id] = answer
            os.write(self.commands, json.dumps(message).encode() + b"\0")
        wait = patience.Wait(f"the browser's answer to {method}", self.has_ended)
        while True:
            try:
                result = answer.get(timeout=0.2)
                break
            except queue.Empty:
                wait.fail_if_ended()
                wait.check()
        if "error" in result:
            problem = f"{method}: {result['error']}"
            raise Navigated(problem) if "navigated" in problem or "Cannot find context" in problem else AssertionError(problem)
        return result["result"]

    def open(self, url, size=(640, 360)):
        return Page(self, url, size)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        patience.forget(self)
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.reader.join(5)
        os.close(self.commands)
        os.close(self.answers)
        self.profile.cleanup()


class Navigated(AssertionError):
    """The page loads another one, and cannot answer."""


class Page:
    def __init__(self, browser, url, size):
        self.browser = browser
        self.url = url
        self.events = 0
        self.problems = []  # exceptions, warnings and errors of its console
        self.requests = []  # addresses
        self.bytes = 0      # that came, without those of WebSockets
        self.socket_bytes = 0
        self.target = browser.call("Target.createTarget", url="about:blank", newWindow=True)["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        browser.pages[self.session] = self
        for domain in ("Runtime", "Log", "Network", "Page"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1,
                  mobile=False)
        self.call("Page.navigate", url=url)

    def close(self):
        """Once: it draws no more, and tells nothing more."""
        if self.browser.pages.pop(self.session, None):
            self.browser.call("Target.closeTarget", targetId=self.target)

    def call(self, method, **parameters):
        return self.browser.call(method, session=self.session, **parameters)

    def on_event(self, method, event):
        self.events += 1
        if method == "Runtime.exceptionThrown":
            details = event["exceptionDetails"]
            self.problems.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and event["type"] in ("warning", "error", "assert"):
            self.problems.append(" ".join(str(a.get("value", a.get("description"))) for a in event["args"]))
        elif method == "Log.entryAdded" and event["entry"]["level"] in ("warning", "error") and \
                "preloaded using link preload but not used within a few seconds" not in event["entry"]["text"]:  # a busy machine
            self.problems.append(event["entry"]["text"] + " " + event["entry"].get("url", ""))
        elif method == "Network.requestWillBeSent":
            self.requests.append(event["request"]["url"])
        elif method == "Network.webSocketFrameReceived":
            data = event["response"]["payloadData"]
            self.socket_bytes += len(data) * 3 // 4 if event["response"]["opcode"] == 2 else len(data)
        elif method == "Network.loadingFinished":
            self.bytes += event["encodedDataLength"]

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait_for(self, condition):
        """Waits until the JavaScript `condition` is true; returns its value."""
        def value():
            try:
                return self.evaluate(condition)
            except Navigated:
                return None  # the page that was asked has gone; the next one answers
        try:
            return patience.wait_until(value, condition, of=self.browser)
        except patience.WaitedInVain as vain:
            if self.browser.has_ended():
                raise
            state = self.evaluate("JSON.stringify(globalThis.theatron?.state ?? null)")
            raise AssertionError(f"{vain}; {self.problems}; {state}") from None

    def enter(self, name="Ada", way=None, speaks=False, tour=False):
        """Enters by the form of an invitation, once that is there. `way`: how the room is shown; None: as the form says.
        Without `tour` as somebody who has seen the tour before."""
        self.wait_for("document.readyState === 'complete' && !!document.getElementById('invitation')?.textContent")
        # A machine without a graphics card has no choice of ways.
        way = f"(document.getElementById('way') ?? {{}}).value = '{way}';" if way else ""
        speaks = "document.getElementById('speaks').checked = true;" if speaks else ""
        if not tour:
            self.evaluate("try { localStorage.setItem('tour', 'seen') } catch {}")
        self.evaluate(f"{way}{speaks}document.getElementById('name').value = '{name}'; document.getElementById('enter').click()")

    def open_sheet(self, name):
        """Opens a panel of the page ("people", "case", "more", "details", "picture"); the focus stays. "": closes it."""
        self.evaluate(f"'{name}' ? theatron.sheet.open('{name}') : theatron.sheet.close()")
        if name in ("people", "case"):
            self.wait_for("!!document.querySelector('#room_panels section')")

    def screenshot(self, path):
        picture = self.call("Page.captureScreenshot", format="png")["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(picture))

    def mouse(self, kind, x, y, button="left", **more):
        """`kind`: mousePressed, mouseReleased, mouseMoved or mouseWheel."""
        held = {"left": 1, "right": 2, "none": 0}[button]
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button,
                  buttons=0 if kind == "mouseReleased" else held, clickCount=int(kind in ("mousePressed", "mouseReleased")),
                  **more)

    def touch(self, kind, *points):
        """`kind`: touchStart, touchMove or touchEnd; `points`: (x, y) of each finger, None for one that is not there."""
        self.call("Input.dispatchTouchEvent", type=kind,
                  touchPoints=[{"x": at[0], "y": at[1], "id": i} for i, at in enumerate(points) if at])

    def middle(self, selector):
        """The middle of an element, in pixels of the window."""
        return self.evaluate("(b => [b.x + b.width / 2, b.y + b.height / 2])"
                             f"(document.querySelector('{selector}').getBoundingClientRect())")

    def click(self, selector):
        """As a person does, with the mouse."""
        place = self.middle(selector)
        self.mouse("mousePressed", *place)
        self.mouse("mouseReleased", *place)

    def press(self, key, code, number=0, text=""):
        """`number` and `text` are needed where the browser itself acts on the key."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code, windowsVirtualKeyCode=number,
                      **({"text": text} if text and kind == "keyDown" else {}))

    def reload(self):
        self.call("Page.reload")
