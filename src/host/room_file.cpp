// SPDX-License-Identifier: Apache-2.0
#include "host/room_file.h"

#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "files/private_file.h"
#include "record/crc32c.h"

namespace theatron::host {
namespace {

constexpr std::uint32_t magic = 0x4d525448;  // "HTRM"
constexpr std::uint32_t version = 1;
constexpr std::size_t max_file_bytes = 1 << 20;

}  // namespace

Bytes encode_room(const session::RoomSnapshot& room) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(magic);
    out.put(version);
    out.put(room.revision);
    out.put_bytes(session::encode_objects(room.objects));
    out.put(record::crc32c(bytes));
    return bytes;
}

Result<session::RoomSnapshot> decode_room(ByteView bytes) {
    constexpr std::size_t check_size = sizeof(std::uint32_t);
    if (bytes.size() < check_size)
        return Status::malformed;
    const ByteView checked = bytes.first(bytes.size() - check_size);
    ByteReader in(checked);
    session::RoomSnapshot room;
    const bool known = in.get<std::uint32_t>() == magic && in.get<std::uint32_t>() == version;
    room.revision = in.get<std::uint64_t>();
    if (!known || !in.ok() ||
        load_le<std::uint32_t>(bytes.data() + checked.size()) != record::crc32c(checked))
        return Status::malformed;
    auto objects = session::decode_objects(in.rest(), 2 * session::RoomState::max_objects);
    if (!objects)
        return objects.error();
    room.objects = std::move(*objects);
    return room;
}

RoomFile::RoomFile(std::filesystem::path path)
    : path_(std::move(path)), thread_([this] {
          name_this_thread("room");
          run();
      }) {}

RoomFile::~RoomFile() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

session::RoomSnapshot RoomFile::load() {
    const auto text = files::read_private_file(path_, files::Privacy::secret, max_file_bytes);
    if (!text)
        return {};
    const auto room = decode_room(as_bytes(*text));
    if (room) {
        saved_version_ = room->revision;
        return *room;
    }
    const auto kept = std::filesystem::path(path_) += ".damaged";
    std::error_code ignored;
    std::filesystem::rename(path_, kept, ignored);
    log::warning("host", "the saved room is damaged; the session begins with an empty one",
                 {{"kept", kept.string()}});
    return {};
}

void RoomFile::on_tick(const session::HostRoom& room, TimePoint now) {
    if (room.version() == saved_version_ || now - saved_ < interval)
        return;
    saved_ = now;
    save(room);
}

void RoomFile::save(const session::HostRoom& room) {
    saved_version_ = room.version();
    Bytes bytes = encode_room(room.snapshot());
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
        (void)contain("room", [&] {
            files::write_private_file(path_,
                                      {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        });
    }
}

}  // namespace theatron::host
