// SPDX-License-Identifier: Apache-2.0
// The page's panels: one at a time, always at the same place. Buttons with data-sheet open and close the panel of that name.

const $ = id => document.getElementById(id);
const openers = () => document.querySelectorAll("[data-sheet]");

export class Sheet {
    name = "";      // of the open panel; "": none
    opener = null;  // gets the focus back from a panel that was opened by the keyboard

    // `title_of` gives a panel's title, `changed` follows each change.
    constructor(title_of, changed) {
        Object.assign(this, { title_of, changed });
        for (const button of openers())
            button.addEventListener("click", event => this.toggle(button.dataset.sheet, event.detail === 0 ? button : null));
        $("close_sheet").addEventListener("click", () => this.close());
    }

    // `opener`: the element that the keyboard pressed; null: a pointer or a key did it, and the focus stays where it is.
    open(name, opener = null) {
        this.name = name;
        this.opener = opener;
        this.show();
        $("sheet_content").scrollTop = 0;
        if (opener)
            $("sheet_title").focus();
    }

    close() {
        const { opener } = this;
        this.name = "";
        this.opener = null;
        this.show();
        opener?.focus();
    }

    toggle(name, opener = null) {
        if (this.name === name)
            this.close();
        else
            this.open(name, opener);
    }

    show() {
        $("sheet").hidden = this.name === "";
        $("sheet").dataset.shows = this.name;
        document.body.classList.toggle("with_sheet", this.name !== "");
        for (const button of openers())
            if (button.hasAttribute("aria-expanded"))
                button.setAttribute("aria-expanded", String(button.dataset.sheet === this.name));
        for (const part of $("sheet_content").querySelectorAll(":scope > [data-of]"))
            part.hidden = part.dataset.of !== this.name;
        this.entitle();
        this.changed();
    }

    entitle() {
        const title = this.name && this.title_of(this.name);
        if ($("sheet_title").textContent !== title)
            $("sheet_title").textContent = title;
    }
}
