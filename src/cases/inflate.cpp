// SPDX-License-Identifier: Apache-2.0
#include "cases/inflate.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <new>

namespace theatron::cases {
namespace {

// The libraries count with 32 bits.
constexpr std::size_t most_at_once = std::size_t(1) << 30;

enum class Step : std::uint8_t { more, end, damaged };

class Inflater {
public:
    explicit Inflater(Packing packing) {
        const int bits = packing == Packing::gzip      ? 16 + MAX_WBITS
                         : packing == Packing::deflate ? -MAX_WBITS
                                                       : MAX_WBITS;
        if (inflateInit2(&stream_, bits) != Z_OK)
            throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;

    Step step(ByteView& in, std::span<std::byte>& out) {
        const std::size_t given = std::min(in.size(), most_at_once);
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in.data()));
        stream_.avail_in = uInt(given);
        stream_.next_out = reinterpret_cast<Bytef*>(out.data());
        stream_.avail_out = uInt(out.size());
        const int result = inflate(&stream_, Z_NO_FLUSH);
        in = in.subspan(given - stream_.avail_in);
        out = out.last(stream_.avail_out);
        return result == Z_STREAM_END ? Step::end : result == Z_OK ? Step::more : Step::damaged;
    }
    void restart() { inflateReset(&stream_); }

private:
    z_stream stream_{};
};

class Bunzipper {
public:
    Bunzipper() { start(); }
    ~Bunzipper() { BZ2_bzDecompressEnd(&stream_); }
    Bunzipper(const Bunzipper&) = delete;

    Step step(ByteView& in, std::span<std::byte>& out) {
        const std::size_t given = std::min(in.size(), most_at_once);
        stream_.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(in.data()));
        stream_.avail_in = unsigned(given);
        stream_.next_out = reinterpret_cast<char*>(out.data());
        stream_.avail_out = unsigned(out.size());
        const std::size_t room = out.size();
        const int result = BZ2_bzDecompress(&stream_);
        in = in.subspan(given - stream_.avail_in);
        out = out.last(stream_.avail_out);
        // Without progress the packed bytes end too early.
        const bool stuck = in.empty() && given == 0 && out.size() == room;
        return result == BZ_STREAM_END     ? Step::end
               : result == BZ_OK && !stuck ? Step::more
                                           : Step::damaged;
    }
    void restart() {
        BZ2_bzDecompressEnd(&stream_);
        start();
    }

private:
    void start() {
        stream_ = {};
        if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK)
            throw std::bad_alloc();
    }
    bz_stream stream_{};
};

template <class Unpacker>
std::size_t run(Unpacker& unpacker, ByteView packed, ByteView magic, std::size_t wanted,
                const std::function<bool(ByteView)>& take, bool& damaged) {
    Bytes piece(64 << 10);
    std::size_t done = 0;
    damaged = false;
    while (done < wanted) {
        std::span<std::byte> room(piece.data(), std::min(piece.size(), wanted - done));
        const std::size_t before = room.size();
        const Step step = unpacker.step(packed, room);
        const std::size_t count = before - room.size();
        done += count;
        if (count > 0 && !take(ByteView(piece).first(count)))
            return done;
        if (step == Step::more)
            continue;
        damaged = step == Step::damaged;
        const bool goes_on = !damaged && !magic.empty() && packed.size() > magic.size() &&
                             std::equal(magic.begin(), magic.end(), packed.begin());
        if (!goes_on)
            return done;
        unpacker.restart();
    }
    return done;
}

}  // namespace

std::size_t unpack(ByteView packed, Packing packing, std::size_t wanted,
                   const std::function<bool(ByteView)>& take, bool& damaged) {
    constexpr std::byte gzip[] = {std::byte(0x1f), std::byte(0x8b)};
    constexpr std::byte bzip2[] = {std::byte('B'), std::byte('Z'), std::byte('h')};
    if (packing == Packing::bzip2) {
        Bunzipper unpacker;
        return run(unpacker, packed, bzip2, wanted, take, damaged);
    }
    Inflater unpacker(packing);
    return run(unpacker, packed, packing == Packing::gzip ? ByteView(gzip) : ByteView(), wanted,
               take, damaged);
}

Unpacked unpack(ByteView packed, Packing packing, std::size_t most) {
    Unpacked unpacked;
    bool damaged = false;
    const std::size_t size = unpack(
        packed, packing, most + 1,
        [&](ByteView piece) {
            unpacked.bytes.insert(unpacked.bytes.end(), piece.begin(), piece.end());
            return true;
        },
        damaged);
    unpacked.too_large = size > most;
    unpacked.whole = !damaged && !unpacked.too_large;
    return unpacked;
}

}  // namespace theatron::cases
