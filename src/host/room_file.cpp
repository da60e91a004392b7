// SPDX-License-Identifier: Apache-2.0
#include "host/room_file.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "files/private_file.h"
#include "record/crc32c.h"

namespace theatron::host {
namespace {

constexpr std::uint32_t magic = 0x4d525448;  // "HTRM"
constexpr std::uint32_t version = 2, version_without_times = 1;
constexpr std::size_t max_file_bytes = 1 << 20;

// Where a file that cannot be used is kept. Of many such files the last one takes the last name.
std::filesystem::path free_name(const std::filesystem::path& path) {
    constexpr int max_kept = 20;
    std::filesystem::path kept = path;
    kept += ".damaged";
    for (int n = 2; n <= max_kept && std::filesystem::exists(kept); ++n) {
        kept = path;
        kept += ".damaged." + std::to_string(n);
    }
    return kept;
}

}  // namespace

Bytes encode_room(const SavedRoom& saved) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(magic);
    out.put(version);
    out.put(saved.room.revision);
    out.put(to_us(saved.session_time));
    out.put(std::int64_t(saved.utc.time_since_epoch().count()));
    out.put_bytes(session::encode_objects(saved.room.objects));
    out.put(record::crc32c(bytes));
    return bytes;
}

Result<SavedRoom> decode_room(ByteView bytes) {
    constexpr std::size_t check_size = sizeof(std::uint32_t);
    if (bytes.size() < check_size)
        return Status::malformed;
    const ByteView checked = bytes.first(bytes.size() - check_size);
    ByteReader in(checked);
    SavedRoom saved;
    const bool is_room = in.get<std::uint32_t>() == magic;
    const auto of_version = in.get<std::uint32_t>();
    const bool known = is_room && (of_version == version || of_version == version_without_times);
    saved.room.revision = in.get<std::uint64_t>();
    if (of_version == version) {
        saved.session_time = from_us(in.get<std::int64_t>());
        saved.utc = UtcTime(std::chrono::microseconds(in.get<std::int64_t>()));
    }
    if (!in.ok() ||
        load_le<std::uint32_t>(bytes.data() + checked.size()) != record::crc32c(checked))
        return Status::malformed;
    if (!known)
        return is_room ? Status::unsupported : Status::malformed;
    auto objects = session::decode_objects(in.rest(), 2 * session::RoomState::max_objects);
    if (!objects)
        return objects.error();
    saved.room.objects = std::move(*objects);
    return saved;
}

RoomFile::RoomFile(std::filesystem::path path)
    : path_(std::move(path)), thread_([this] {
          name_this_thread("room");
          run();
      }) {}

RoomFile::~RoomFile() {
    close();
}

void RoomFile::close() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

std::string RoomFile::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

session::RoomSnapshot RoomFile::load() {
    std::error_code ignored;
    const bool too_large = std::filesystem::file_size(path_, ignored) > max_file_bytes && !ignored;
    const auto text = too_large
                          ? std::nullopt
                          : files::read_private_file(path_, files::Privacy::secret, max_file_bytes);
    if (!text && !too_large)
        return {};
    auto saved = too_large ? Result<SavedRoom>(Status::too_large) : decode_room(as_bytes(*text));
    if (saved) {
        saved_version_ = saved->room.revision;
        log::info("host", "the saved room is used",
                  {{"objects", saved->room.objects.size()}, {"saved", utc_text(saved->utc)}});
        return std::move(saved->room);
    }
    const std::filesystem::path kept = free_name(path_);
    std::filesystem::rename(path_, kept, ignored);
    log::warning("host",
                 saved.error() == Status::unsupported
                     ? "the saved room is of a newer version; the session begins with an empty one"
                     : "the saved room is damaged; the session begins with an empty one",
                 {{"kept", kept.string()}});
    return {};
}

void RoomFile::on_tick(const session::HostRoom& room, TimePoint now) {
    if (now - saved_ < interval || (room.version() == saved_version_ && problem().empty()))
        return;
    saved_ = now;
    save(room, now);
}

void RoomFile::save(const session::HostRoom& room, TimePoint now) {
    saved_version_ = room.version();
    Bytes bytes = encode_room({room.snapshot(), now, utc_now()});
    {
        const std::lock_guard lock(mutex_);
        waiting_ = std::move(bytes);
    }
    changed_.notify_all();
}

void RoomFile::run() {
    while (true) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return waiting_ || stopping_; });
        if (!waiting_)
            return;
        const Bytes bytes = std::move(*std::exchange(waiting_, std::nullopt));
        lock.unlock();
        std::string problem;
        try {
            files::write_private_file(path_,
                                      {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        } catch (const std::exception& error) {
            problem = error.what();
        }
        lock.lock();
        // Said once, not each second.
        const bool is_new = !problem.empty() && problem_.empty();
        const bool is_over = problem.empty() && !problem_.empty();
        problem_ = problem;
        lock.unlock();
        if (is_new)
            log::error("host", "the room cannot be saved and would be lost with this host",
                       {{"why", problem}});
        if (is_over)
            log::info("host", "the room is saved again");
    }
}

}  // namespace theatron::host
