// SPDX-License-Identifier: Apache-2.0
// The cases of a session at a participant: those that the host offers, and the content of the one
// that is open in the room, in memory only.
//
// Content that has come is decoded on a thread of its own, in a browser's page at once.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "image/image.h"
#include "medical/mesh.h"
#include "medical/shared_case.h"
#include "medical/volume.h"
#include "session/content_fetch.h"
#include "session/room_object.h"

namespace theatron::client {

// The case that is open in the room, as far as its content has come.
struct OpenCase {
    ContentHash id;
    std::optional<medical::SharedCase> description;
    // One for each part, series and picture; null: it has not come.
    std::vector<std::shared_ptr<const medical::Mesh>> meshes;
    std::vector<std::shared_ptr<const medical::Volume>> volumes;
    std::vector<std::shared_ptr<const ColorImage>> pictures;
    session::ContentFetch::Progress progress;
    std::string problem;  // a sentence on why something is missing for good; empty: nothing is
    // All content is there.
    bool is_complete() const;
};

// All functions: from any thread.
class CaseKeeper {
public:
    // Content of one case, and of the cases before it that are kept for being opened again.
    static constexpr std::uint64_t max_case_bytes = std::uint64_t(1) << 30;
    static constexpr std::uint64_t max_description_bytes = std::uint64_t(1) << 20;

    // `changed`: open() or offered() has changed; `requests`: take_requests() has some. Both from
    // any thread.
    CaseKeeper(std::function<void()> changed, std::function<void()> requests);
    ~CaseKeeper();

    void on_connected();
    void on_offer(std::vector<wire::OfferedCase> cases);
    // The room's objects as the host decided.
    void on_room(const session::RoomObjects& objects);
    void on_content(const wire::Content& piece, TimePoint now);
    std::vector<wire::RequestContent> take_requests(TimePoint now);

    std::vector<wire::OfferedCase> offered() const;
    // nullopt: no case is open. `version` grows with each change of it but its progress.
    std::optional<OpenCase> open(std::uint64_t& version) const;

private:
    using Content =
        std::variant<std::shared_ptr<const medical::Mesh>, std::shared_ptr<const medical::Volume>,
                     std::shared_ptr<const ColorImage>, std::shared_ptr<const medical::SharedCase>,
                     std::string>;
    enum class Kind { description, mesh, volume, picture };
    struct Waiting {
        ContentHash hash;
        Kind kind{};
        Bytes bytes;
    };
    struct Kept {
        Content content;  // a text: why it cannot be shown
        std::uint64_t size = 0;
    };
    void run();
    void decode_next(std::unique_lock<std::mutex>& lock);
    static Content decode(const Waiting& waiting);
    std::shared_ptr<const medical::SharedCase> description() const;
    void want();  // mutex_ is held, as for the next
    std::optional<Kind> kind_of(const ContentHash& hash) const;
    void forget_others();

    const std::function<void()> changed_, requests_;
    mutable std::mutex mutex_;  // guards all below
    std::condition_variable work_;
    session::ContentFetch fetch_;
    std::vector<wire::OfferedCase> offered_;
    std::optional<ContentHash> open_;
    bool is_recorded_ = false;  // open_ is that of a recording
    std::map<ContentHash, Kept> kept_;
    std::deque<Waiting> waiting_;
    std::uint64_t version_ = 0;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::client
