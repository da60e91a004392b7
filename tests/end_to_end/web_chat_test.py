# SPDX-License-Identifier: Apache-2.0
"""Messages and raised hands in the page, beside a program without one."""
import os
import pathlib
import signal
import unittest

from page_case import PageCase
from theatron_process import Process
from web_access_test import AXE, CONTRAST, FINDINGS

PICTURES = os.environ.get("THEATRON_PICTURES")  # a folder where pictures of the page stay
SIZES = ((1280, 720), (390, 844))
IMPORT = "import(performance.getEntriesByType('resource').find(({ name }) => name.includes('/chat.')).name)"
HEADS = "[...document.querySelectorAll('#chat_list li .detail')].map(p => p.textContent.split(' ')[0])"
LIST = "[...document.querySelectorAll('#chat_list li p')].map(p => p.textContent)"


def hands_of(facts):
    return [p["name"] for p in facts["room"]["people"] if p["hand_raised"]]


class WebChat(PageCase):
    cameras = ("synthetic:seconds=2,fps=5,quality=quick,loop=1",)

    def enter(self, size=SIZES[0], role="expert", name="Ada", language="en"):
        page = self.browser.open("about:blank", size)
        page.call("Page.addScriptToEvaluateOnNewDocument",
                  source=f"Object.defineProperty(navigator, 'language', {{ get: () => '{language}' }})")
        page.call("Page.navigate", url=self.links[role])
        page.enter(name, way="room")
        page.wait_for("theatron.state.phase === 'joined' && theatron.state.chat.may_write")
        return page

    def other(self, name, role="expert"):
        return Process("join", self.links[role], "--name", name, "--every", "0.1",
                       env={**os.environ, "XDG_STATE_HOME": str(self.folder / f"home of {name}")})

    def press(self, page, element):
        page.evaluate(f"document.querySelector('{element}').click()")

    def write(self, page, text):
        page.evaluate(f"document.getElementById('chat_text').value = {text!r}")
        page.evaluate("document.getElementById('chat_form').requestSubmit()")

    def test_messages_of_others_are_announced_counted_read_and_answered(self):
        with self.other("Ben", "operator") as ben:
            ben.wait_for(lambda f: f["chat"]["may_write"])
            page = self.enter()
            ben.say("chat <b>Please</b> look here")
            page.wait_for("document.getElementById('notice').textContent.includes('Ben: <b>Please</b> look here')")
            page.wait_for("document.getElementById('unseen').textContent === 'New messages: 1'")
            self.press(page, "#unseen")
            page.wait_for(f"{LIST}.join() === '<b>Please</b> look here' && document.getElementById('unseen').hidden")
            self.write(page, "Yes, I see")
            ben.wait_for(lambda f: [m["text"] for m in f["chat"]["messages"]] == ["<b>Please</b> look here", "Yes, I see"])
            page.wait_for(f"{LIST}.length === 2 && document.getElementById('chat_text').value === ''")
            page.wait_for("document.querySelector('#chat_list .own .detail').textContent.startsWith('You')")
            self.press(page, "[data-quick=one_moment]")
            ben.wait_for(lambda f: f["chat"]["messages"][-1]["text"] == "One moment")
            with self.subTest("letters written there are no commands of the room"):
                page.evaluate("document.getElementById('chat_text').focus()")
                page.press("n", "KeyN", 78, "n")
                page.wait_for("document.getElementById('chat_text').value === 'n'")
                self.assertEqual(page.evaluate("theatron.state.bricks"), 0)
            with self.subTest("who is muted sees that nothing can be written"):
                ben.say("mute Ada")
                page.wait_for("document.getElementById('chat_text').disabled"
                              " && document.getElementById('chat_hint').textContent === 'You cannot write at present.'")
                ben.say("unmute Ada")
                page.wait_for("!document.getElementById('chat_text').disabled && !document.getElementById('chat_hint').textContent")
            self.assertEqual(page.problems, [])
            self.leave(page)

    def joined(self, page, name):
        page.enter(name, way="room")
        page.wait_for("theatron.state.phase === 'joined' && theatron.state.chat.may_write")
        page.open_sheet("chat")

    def load_again(self, page):
        page.call("Page.reload")
        self.wait_for_form(page)

    def wait_for_form(self, page):
        page.wait_for("document.readyState === 'complete' && globalThis.theatron?.state.phase === 'left'"
                      " && !document.getElementById('enter').disabled")

    def test_a_page_that_is_loaded_again_has_what_was_written_seen_and_raised_in_its_stay(self):
        with self.other("Ben") as ben:
            ben.wait_for(lambda f: f["chat"]["may_write"])
            page = self.enter()
            page.open_sheet("chat")
            self.write(page, "mine")
            ben.wait_for(lambda f: len(f["chat"]["messages"]) == 1)
            ben.say("chat theirs")
            page.wait_for(f"{LIST}.join() === 'mine,theirs'")
            self.press(page, "#raise_hand")
            ben.wait_for(lambda f: hands_of(f) == ["Ada"])
            # The host does not answer: the person does not know whether it has the message.
            os.kill(self.host.process.pid, signal.SIGSTOP)
            try:
                self.write(page, "on its way")
                page.wait_for("!!document.querySelector('#chat_list .unsent')")
                page.call("Page.reload")
            finally:
                os.kill(self.host.process.pid, signal.SIGCONT)
            self.wait_for_form(page)
            ben.say("chat meanwhile")
            ben.wait_for(lambda f: "meanwhile" in [m["text"] for m in f["chat"]["messages"]])
            page.enter("Ada", way="room")
            page.wait_for("theatron.state.phase === 'joined' && theatron.state.chat.may_write")
            # Those that were seen before count no more.
            page.wait_for("document.getElementById('unseen').textContent === 'New messages: 1'")
            page.open_sheet("chat")
            page.wait_for(f"{LIST}.sort().join() === 'meanwhile,mine,on its way,theirs'")
            self.assertEqual(sorted(page.evaluate(HEADS)), ["Ben", "Ben", "You", "You"])
            ben.wait_for(lambda f: hands_of(f) == ["Ada"])
            ben.wait_for(lambda f: [p["name"] for p in f["room"]["people"]].count("Ada") == 1)
            self.assertEqual(sorted(m["text"] for m in ben.newest_json()["chat"]["messages"]), ["meanwhile", "mine", "on its way", "theirs"])
            self.press(page, "#raise_hand")
            ben.wait_for(lambda f: not hands_of(f))
            with self.subTest("a tab that was duplicated is another stay"):
                kept, number = page.evaluate("[sessionStorage.getItem(theatron.run.key), theatron.run.number]")
                copy = self.browser.open(self.links["expert"], SIZES[0])
                copy.wait_for("!!globalThis.theatron?.run")
                copy.evaluate(f"sessionStorage.setItem(theatron.run.key, {kept!r})")
                self.assertNotEqual(copy.evaluate("theatron.run.find('Ada').then(() => theatron.run.number)"), number)
            self.assertEqual(page.problems, [])

    def test_the_next_person_in_the_tab_reads_nothing(self):
        with self.other("Ben") as ben:
            ben.wait_for(lambda f: f["chat"]["may_write"])
            page = self.enter()

            def next_person(name, words):
                with self.subTest(words):
                    self.joined(page, name)
                    ben.say(f"chat for {name}")
                    page.wait_for(f"{LIST}.join() === 'for {name}'")
                    self.assertEqual(page.evaluate("document.getElementById('chat_text').value"), "")
                    self.write(page, "secret")
                    page.wait_for(f"{LIST}.length === 2 && !document.querySelector('#chat_list .unsent')")
            page.open_sheet("chat")
            self.write(page, "secret")
            page.wait_for("!!document.querySelector('#chat_list .own') && !document.querySelector('#chat_list .unsent')")
            page.evaluate("document.getElementById('chat_text').value = 'half written'")
            self.leave(page)
            self.assertEqual(page.evaluate("document.getElementById('chat_list').textContent"), "")
            next_person("Eva", "after Leave")
            # Both in one turn of the page: the picture that ends the stay is never drawn.
            page.evaluate("document.getElementById('leave').click(); location.reload()")
            self.wait_for_form(page)
            next_person("Dan", "loaded again at once after Leave")
            self.load_again(page)
            next_person("Fay", "loaded again, and another name")
            self.assertEqual(page.problems, [])

    def test_one_enters_again_whatever_the_browser_keeps_or_lacks(self):
        kept = "sessionStorage.setItem(theatron.run.key, {!r})"
        for words, before, memory in (
                ("no time limits", "delete AbortSignal.timeout", None),
                ("locks are refused", "navigator.locks.request = () => { throw new Error('denied'); }", None),
                ("no locks", "Object.defineProperty(Navigator.prototype, 'locks', { get: () => undefined })", None),
                ("damaged memory", "", "{{{"),
                ("memory of other types", "", '{"number":"00112233445566ff","name":"Ada","own":7,"unsent":[null,{"id":[]},{"text":3}],"seen":{}}'),
                ("memory of nothing", "", "null")):
            with self.subTest(words):
                page = self.browser.open("about:blank", SIZES[0])
                page.call("Page.addScriptToEvaluateOnNewDocument", source=before)
                page.call("Page.navigate", url=self.links["expert"])
                page.enter("Ada", way="flat")
                page.wait_for("theatron.state.phase === 'joined'")
                self.load_again(page)
                if memory is not None:
                    page.evaluate(kept.format(memory))
                page.enter("Ada", way="flat")
                page.wait_for("theatron.state.phase === 'joined'")
                self.assertEqual(page.problems, [])
                page.close()

    def test_what_shows_nothing_is_not_sent(self):
        page = self.enter()
        page.open_sheet("chat")
        for words in ("\u200b\u200b", " \u00a0\u3000", "\u202e\u2066"):
            self.write(page, words)
            self.assertEqual(page.evaluate("document.getElementById('chat_hint').textContent"), "")
        self.assertEqual(page.evaluate(f"{LIST}.length"), 0)

    def test_messages_are_counted_and_names_are_few(self):
        page = self.browser.open(self.links["expert"], SIZES[0])
        page.wait_for("document.readyState === 'complete' && !document.getElementById('enter')?.disabled")
        unseen = f"{IMPORT}.then(m => m.unseen_of(%s.map(([id, is_own]) => ({{ id, is_own: !!is_own }})), '%s'))"
        for messages, seen, count in (([], "", 0), ([["a", 0], ["b", 1], ["c", 0]], "", 2), ([["a", 0], ["b", 1], ["c", 0]], "b", 1),
                                      ([["a", 0], ["b", 1]], "b", 0), ([["y", 0], ["z", 0]], "gone", 2)):
            self.assertEqual(page.evaluate(unseen % (messages, seen)), count, (messages, seen))
        for names, told in ((["A"], "A"), (list("ABC"), "A, B, C"), (list("ABCDE"), "A, B, C, and 2 more")):
            self.assertEqual(page.evaluate(f"{IMPORT}.then(m => m.names_text({names}))"), told)

    def test_own_messages_stay_own_until_the_host_sends_them_again(self):
        page = self.enter()
        kept = page.evaluate(IMPORT + """.then(({ Chat }) => {
            const kept = [], of = (...ids) => JSON.stringify({ messages: ids.map(id => ({ id, name: "A", text: "t", is_own: id > 6, age_s: 1 })), unsent: [] });
            const client = { go_on() {}, answer: of(), chat() { return this.answer; } };
            const chat = new Chat(client, { name: "" }, { keep: stay => kept.push(stay.own.join()) });
            chat.begin({ own: ["7"], unsent: [], seen: "", hand_raised: false });
            chat.show({ chat: { version: 1 } }, 1);
            client.answer = of("5", "7", "9");
            chat.show({ chat: { version: 2 } }, 1);
            chat.forget();
            return [...kept, chat.own.length];
        })""")
        self.assertEqual(kept, ["7", "7,9", 0])

    def test_a_hand_goes_up_for_all_also_of_an_observer(self):
        with self.other("Ben", "operator") as ben:
            ben.wait_for(lambda f: f["chat"]["may_write"])
            page = self.enter(role="observer")
            self.press(page, "#raise_hand")
            ben.wait_for(lambda f: hands_of(f) == ["Ada"])
            page.wait_for("document.getElementById('hands').textContent === 'Hand raised: You'")
            ben.say("hand up")
            page.wait_for("document.getElementById('hands').textContent === 'Hand raised: You, Ben'")
            ben.say("lower Ada")
            page.wait_for("document.getElementById('hands').textContent === 'Hand raised: Ben'"
                          " && document.getElementById('raise_hand').getAttribute('aria-pressed') === 'false'")
            ben.say("hand down")
            page.wait_for("document.getElementById('hands').hidden")
            self.leave(page)

    def test_it_is_readable_in_each_size_scheme_and_language(self):
        with self.other("Dr. Benedikta Langenscheidt", "operator") as ben:
            ben.wait_for(lambda f: f["chat"]["may_write"])
            for language, size in (("en", SIZES[0]), ("de", SIZES[1]), ("fr", SIZES[0])):
                page = self.enter(size, language=language)
                for i in range(4):
                    ben.say(f"chat Message {i} with some more words than fit into one line of a narrow page")
                page.wait_for("document.getElementById('unseen').textContent.includes('4')")
                self.press(page, "#show_chat")
                self.write(page, "Ja")
                page.wait_for(f"{LIST}.length === 5")
                page.wait_for("(l => l.scrollTop + l.clientHeight > l.scrollHeight - 3)(document.getElementById('chat_list'))")
                with self.subTest(language=language, size=size):
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), size[0], "wider than the page")
                    for scheme in ("light", "dark"):
                        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
                        self.assertEqual(page.evaluate(CONTRAST), [], scheme)
                        if AXE.exists():
                            if page.evaluate("globalThis.axe === undefined"):
                                page.evaluate(AXE.read_text() + ";0")
                            self.assertEqual(page.evaluate(FINDINGS), [], scheme)
                        if PICTURES:
                            page.screenshot(pathlib.Path(PICTURES) / f"chat_{language}_{size[0]}_{scheme}.png")
                self.leave(page)
                page.close()


if __name__ == "__main__":
    unittest.main()
