// SPDX-License-Identifier: Apache-2.0
// Asks a host's lobby again and again, on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/time.h"
#include "image/image.h"
#include "net/link.h"

namespace theatron::app {

class LobbyWatch {
public:
    static constexpr Duration interval = std::chrono::seconds(2);
    static constexpr Duration patience = std::chrono::seconds(3);  // for one answer

    // The moving of a json value throws nothing, but its assertions are not marked so.
    struct Answer {            // NOLINT(bugprone-exception-escape)
        nlohmann::json lobby;  // null with a problem
        std::string problem;   // one sentence
        ColorImage picture;    // empty: there is none
    };

    // `news` is called from the thread after each answer.
    explicit LobbyWatch(std::function<void()> news);
    // Does not wait for an answer that is under way; `news` is not called any more.
    ~LobbyWatch();

    // Asks this host from now on, at once; none: no host. Forgets the answer of another one.
    void set_link(const std::optional<net::Link>& link);
    // The answer since the last call, if there is a new one.
    std::optional<Answer> take();

private:
    // The data that a question under way needs, too.
    struct Shared;
    static void run(Shared& shared);
    static Answer ask(const net::Link& link);

    const std::shared_ptr<Shared> shared_;
};

}  // namespace theatron::app
