// SPDX-License-Identifier: Apache-2.0
// One page in Chromium without a window, driven by its DevTools protocol over a pipe.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "image/view.h"

namespace theatron::bench {

// The program `chromium` of $PATH.
std::optional<std::string> find_chromium();

// For one thread. All functions throw Error where the browser does not answer.
class BrowserPage {
public:
    // Starts a browser with an empty profile. It does not check certificates, because hosts make
    // their own. `script` runs before the page's own. It ends with this object.
    BrowserPage(const std::string& chromium, Size size, const std::string& script);
    ~BrowserPage();
    BrowserPage(const BrowserPage&) = delete;
    BrowserPage& operator=(const BrowserPage&) = delete;

    void open(const std::string& url);
    // The value of a JavaScript expression; of a promise, what it becomes.
    nlohmann::json evaluate(const std::string& expression);
    // Asks until the expression is true.
    void wait_for(const std::string& expression, Duration patience);

    // That came for the page, without what its sockets brought.
    std::uint64_t transferred_bytes() const { return transferred_bytes_; }
    // Exceptions of the page.
    const std::vector<std::string>& problems() const { return problems_; }

private:
    nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
    nlohmann::json next_message();
    void on_event(const nlohmann::json& message);

    std::string profile_, session_, unread_;
    int pid_ = -1, commands_ = -1, answers_ = -1;
    int last_id_ = 0;
    std::uint64_t transferred_bytes_ = 0;
    std::vector<std::string> problems_;
};

}  // namespace theatron::bench
