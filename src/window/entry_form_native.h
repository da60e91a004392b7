// SPDX-License-Identifier: Apache-2.0
// The form before a session: the link or one of those entered before, the person's name, voice, and
// what the host says of its session.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "image/image.h"
#include "image/view.h"
#include "window/form_input.h"

namespace theatron::window {

// The fields that a person fills in.
struct EntryFields {
    std::string link, name;
    bool hears = true;              // the others
    bool speaks = false;            // to the others
    bool voice_may_record = false;  // the person agrees that others record the voice
    bool shows_face = false;        // with a webcam

    bool operator==(const EntryFields&) const = default;
};

// Texts about the session that the link leads to.
struct EntryFacts {
    std::string title;  // the session's name; empty: no host has answered
    std::vector<std::string> lines;
    std::string hint;  // the next step, or a problem
    bool is_problem = false;
    bool can_enter = false;

    bool operator==(const EntryFacts&) const = default;
};

// A session that the person has entered before.
struct EntryRecent {
    std::string session;  // its name
    std::string place;    // the rest of its line, for example the role and the host
};

// The person has chosen one of the sessions entered before, or wants it to be offered no more.
struct RecentAnswer {
    std::size_t index = 0;
    bool forgets = false;
};

enum class EntryAnswer { none, enter, leave };

// Needs the window's GL context current, also in the destructor.
class EntryForm {
public:
    struct Clipboard {
        std::function<std::string()> text;
        std::function<void(const std::string&)> set_text;
    };

    // Throws Error where the driver does not accept the shaders.
    EntryForm(EntryFields fields, Clipboard clipboard);
    ~EntryForm();

    // Offers these below the field of the link.
    void set_recents(std::vector<EntryRecent> recents);
    // Fills in a link that is not shown in letters until the person edits it.
    void set_hidden_link(const std::string& link);
    // The answer since the last call.
    std::optional<RecentAnswer> take_recent();

    // A small picture of the session; an empty view removes it.
    void set_picture(ColorView picture);

    // A session is forgotten by a second press on its button within this time, before the mouse
    // leaves it: the first one may be meant for something else.
    static constexpr Duration sure_within = std::chrono::seconds(3);

    // Takes the input and draws into the framebuffer, usually the window's. `text_pixels` is the
    // height of a normal text.
    EntryAnswer draw(const EntryFacts& facts, const FormInput& input, Size window,
                     double text_pixels, TimePoint now, unsigned framebuffer = 0);
    // True while the input is not used up, or a text cursor blinks: draw() must follow soon.
    bool is_animated() const;
    const EntryFields& fields() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::window
