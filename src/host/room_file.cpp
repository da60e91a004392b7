// SPDX-License-Identifier: Apache-2.0
#include "host/room_file.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "files/private_file.h"
#include "record/crc32c.h"

namespace theatron::host {
namespace {

constexpr std::uint32_t magic = 0x4d525448;  // "HTRM"
constexpr std::uint32_t version = 4, version_without_authors = 3, version_without_adjustments = 2,
                        version_without_times = 1;
constexpr std::size_t max_file_bytes = 1 << 20;

// Where a file that cannot be used is kept. The last one of many such files takes the last name.
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

constexpr std::size_t max_name_bytes = 4 * wire::max_name;

void put_text(ByteWriter& out, const std::string& text) {
    out.put(std::uint16_t(text.size()));
    out.put_bytes(as_bytes(text));
}

std::string get_text(ByteReader& in) {
    const ByteView bytes = in.get_bytes(in.get<std::uint16_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void put_adjustments(ByteWriter& out, const RoomFile::Adjustments& adjustments) {
    out.put(std::uint16_t(adjustments.size()));
    for (const session::KeptAdjustment& kept : adjustments) {
        put_text(out, kept.publisher);
        put_text(out, kept.camera);
        const auto& [rotation, place] = kept.registered;
        for (const double value :
             {rotation.w, rotation.x, rotation.y, rotation.z, place.x, place.y, place.z})
            out.put_f64(value);
        const Bytes bytes = session::encode_adjustment(kept.adjustment);
        out.put(std::uint8_t(bytes.size()));
        out.put_bytes(bytes);
    }
}

// False if there is none that can be used.
bool get_adjustments(ByteReader& in, RoomFile::Adjustments& adjustments) {
    const std::size_t count = in.get<std::uint16_t>();
    if (count > session::KeptAdjustments::max_kept)
        return false;
    for (std::size_t i = 0; i < count; ++i) {
        session::KeptAdjustment kept;
        kept.publisher = get_text(in);
        kept.camera = get_text(in);
        auto& [rotation, place] = kept.registered;
        bool is_finite = true;
        for (double* value :
             {&rotation.w, &rotation.x, &rotation.y, &rotation.z, &place.x, &place.y, &place.z}) {
            *value = in.get_f64();
            is_finite = is_finite && std::isfinite(*value);
        }
        const auto adjustment = session::decode_adjustment(in.get_bytes(in.get<std::uint8_t>()));
        if (!in.ok() || !is_finite || !adjustment || kept.publisher.size() > max_name_bytes ||
            kept.camera.size() > max_name_bytes)
            return false;
        kept.adjustment = *adjustment;
        adjustments.push_back(std::move(kept));
    }
    return true;
}

}  // namespace

Bytes encode_room(const SavedRoom& saved) {
    session::HostRoom::Authors authors = saved.authors;
    std::erase_if(authors, [&](const auto& one) {
        return one.second.size() != wire::person_id_size || !saved.room.objects.contains(one.first);
    });
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(magic);
    out.put(version);
    out.put(saved.room.revision);
    out.put(to_us(saved.session_time));
    out.put(std::int64_t(saved.utc.time_since_epoch().count()));
    put_adjustments(out, saved.adjustments);
    out.put(std::uint32_t(authors.size()));
    for (const auto& [mark, person] : authors) {
        out.put(std::uint32_t(mark));
        out.put_bytes(person);
    }
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
    const bool known = is_room && of_version >= version_without_times && of_version <= version;
    saved.room.revision = in.get<std::uint64_t>();
    if (known && of_version >= version_without_adjustments) {
        saved.session_time = from_us(in.get<std::int64_t>());
        saved.utc = UtcTime(std::chrono::microseconds(in.get<std::int64_t>()));
    }
    if (!in.ok() ||
        load_le<std::uint32_t>(bytes.data() + checked.size()) != record::crc32c(checked))
        return Status::malformed;
    if (!known)
        return is_room ? Status::unsupported : Status::malformed;
    if (of_version >= version_without_authors && !get_adjustments(in, saved.adjustments))
        return Status::malformed;
    if (of_version == version)
        for (auto left = in.get<std::uint32_t>(); left > 0 && in.ok(); --left) {
            const session::ObjectId mark{in.get<std::uint32_t>()};
            const ByteView person = in.get_bytes(wire::person_id_size);
            saved.authors[mark] = Bytes(person.begin(), person.end());
        }
    if (!in.ok())
        return Status::malformed;
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

SavedRoom RoomFile::load() {
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
        saved_adjustments_ = saved->adjustments;
        log::info("host", "the saved room is used",
                  {{"objects", saved->room.objects.size()}, {"saved", utc_text(saved->utc)}});
        return std::move(*saved);
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

void RoomFile::on_tick(const session::HostRoom& room, const Adjustments& adjustments,
                       TimePoint now) {
    const bool is_saved = room.version() == saved_version_ && adjustments == saved_adjustments_;
    if (now - saved_ < interval || (is_saved && problem().empty()))
        return;
    saved_ = now;
    save(room, adjustments, now);
}

void RoomFile::save(const session::HostRoom& room, const Adjustments& adjustments, TimePoint now) {
    saved_version_ = room.version();
    saved_adjustments_ = adjustments;
    Bytes bytes = encode_room({room.snapshot(), room.authors(), now, utc_now(), adjustments});
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
