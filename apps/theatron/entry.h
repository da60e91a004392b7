// SPDX-License-Identifier: Apache-2.0
// The form before a session, for a person who has no link on the command line, or no name yet.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "client/recent_links.h"
#include "net/link.h"
#include "window/desktop_window_native.h"
#include "window/entry_form_native.h"

namespace theatron::app {

// A person who wants to enter a session.
struct Entered {
    net::Link link;
    window::EntryFields fields;
};

// Shows the form until the person enters or leaves (nullopt). `problem`: why the last session
// ended, shown until the link changes; may be empty. `forget` is called with a link of `recents`
// that is to be offered no more.
std::optional<Entered> ask_entry(window::DesktopWindow& window, window::EntryFields fields,
                                 const std::string& problem, client::RecentLinks recents,
                                 const std::function<void(const std::string& link)>& forget);

// Turns the answer of a host's lobby into the texts of the form.
window::EntryFacts entry_facts(const nlohmann::json& lobby);

}  // namespace theatron::app
