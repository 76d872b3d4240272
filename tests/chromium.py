#!/usr/bin/env python3
"""chromium.py PAGE [STEP ...]: open a page of HTML in headless Chromium and do the steps:

    size W H          of the window, pixels
    click X Y         with the left button
    drag X Y DX DY    with the left button
    wheel X Y DY
    js EXPRESSION     print its value
    shot FILE         a picture of the page: PNG, or JPEG by the suffix .jpg

Numbers may be expressions of the page: 'innerWidth / 2'. Exits 77 when there is no Chromium. What the page prints, and errors in it, go to standard error and
make the status 1; so does every connection that it tries to open."""
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile

FLAGS = """--headless=new --no-sandbox --remote-debugging-pipe --use-gl=angle --use-angle=swiftshader
    --enable-unsafe-swiftshader --disable-quic --no-first-run --disable-background-networking
    --disable-component-update --disable-sync --disable-dev-shm-usage --hide-scrollbars
    --window-size=1200,800 --force-device-scale-factor=1""".split()


class Browser:
    """The DevTools protocol over the pipes 3 and 4: messages of JSON that end with a zero byte."""

    def __init__(self, program, profile):
        ours_in, self.to = os.pipe()
        self.from_, ours_out = os.pipe()

        def pipes():
            a, b = os.dup(ours_in), os.dup(ours_out)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, "--user-data-dir=" + profile, "about:blank"], preexec_fn=pipes,
            close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(ours_in)
        os.close(ours_out)
        self.left, self.number, self.session = b"", 0, None
        self.bad = self.loaded = False

    def message(self):
        while b"\0" not in self.left:
            more = os.read(self.from_, 1 << 16)
            if not more:
                sys.exit("chromium ended")
            self.left += more
        one, self.left = self.left.split(b"\0", 1)
        return json.loads(one)

    def listen(self, m):
        what, told = m.get("method"), m.get("params", {})
        if what == "Runtime.exceptionThrown":
            self.complain(told["exceptionDetails"]["exception"].get("description", "exception"))
        elif what == "Runtime.consoleAPICalled":
            self.complain(" ".join(str(a.get("value")) for a in told["args"]))
        elif what == "Log.entryAdded" and told["entry"]["level"] == "error":
            self.complain(told["entry"]["text"])
        elif what == "Page.loadEventFired":
            self.loaded = True
        elif what == "Network.requestWillBeSent":
            url = told["request"]["url"]
            if not url.startswith(("file:", "data:", "about:")):
                self.complain("a connection to " + url)

    def complain(self, text):
        self.bad = True
        print("page:", text, file=sys.stderr)

    def call(self, method, **params):
        self.number += 1
        m = {"id": self.number, "method": method, "params": params}
        if self.session:
            m["sessionId"] = self.session
        os.write(self.to, json.dumps(m).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                if "error" in answer:
                    sys.exit(method + ": " + answer["error"]["message"])
                return answer["result"]
            self.listen(answer)

    def open(self, page):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in "Page", "Runtime", "Log", "Network":
            self.call(domain + ".enable")
        self.call("Page.navigate", url="file://" + os.path.abspath(page))
        while not self.loaded:
            self.listen(self.message())
        self.settle()

    def js(self, text):
        result = self.call("Runtime.evaluate", expression=text, awaitPromise=True,
                           returnByValue=True)
        if "exceptionDetails" in result:
            sys.exit("js: " + result["exceptionDetails"]["exception"].get("description", text))
        return result["result"].get("value")

    def settle(self):
        """Two frames: what was asked for is drawn."""
        self.js("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))")

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def drag(self, x, y, dx, dy):
        self.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        for k in range(1, 5 if dx or dy else 1):
            self.mouse("mouseMoved", x + dx * k / 4, y + dy * k / 4, button="left", buttons=1)
        self.mouse("mouseReleased", x + dx, y + dy, button="left", clickCount=1)


def main(page, steps):
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if not program:
        sys.exit(77)
    with tempfile.TemporaryDirectory() as profile:
        browser = Browser(program, profile)
        try:
            browser.open(page)
            while steps:
                step = steps.pop(0)
                take = lambda n: [float(browser.js(steps.pop(0))) for _ in range(n)]
                if step == "size":
                    w, h = take(2)
                    browser.call("Emulation.setDeviceMetricsOverride", width=int(w), height=int(h),
                                 deviceScaleFactor=1, mobile=False)
                elif step == "click":
                    browser.drag(*take(2), 0, 0)
                elif step == "drag":
                    browser.drag(*take(4))
                elif step == "wheel":
                    x, y, dy = take(3)
                    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=dy)
                elif step == "js":
                    print(browser.js(steps.pop(0)))
                elif step == "shot":
                    path = steps.pop(0)
                    shot = browser.call("Page.captureScreenshot", quality=80,
                                        format="jpeg" if path.endswith(".jpg") else "png")
                    with open(path, "wb") as f:
                        f.write(base64.b64decode(shot["data"]))
                else:
                    sys.exit("no such step: " + step)
                browser.settle()
            return browser.bad
        finally:
            browser.session = None
            browser.call("Browser.close")
            browser.process.wait(timeout=30)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
