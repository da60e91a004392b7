// SPDX-License-Identifier: Apache-2.0
#include "capture/cut_off.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string_view>

namespace theatron::capture {
namespace {

bool begins(ByteView bytes, std::string_view with) {
    const ByteView wanted = as_bytes(with);
    return bytes.size() >= wanted.size() && std::equal(wanted.begin(), wanted.end(), bytes.begin());
}

// An EBML number: the leading zeros of the first byte give the number of further bytes.
std::optional<std::uint64_t> read_size(ByteReader& in) {
    const auto first = in.get<std::uint8_t>();
    const int more = std::countl_zero(first);
    if (more > 7)
        return std::nullopt;
    std::uint64_t value = first & (0x7f >> more);
    bool unknown = value == std::uint64_t(0x7f >> more);
    for (int i = 0; i < more; ++i) {
        const auto next = in.get<std::uint8_t>();
        unknown = unknown && next == 0xff;
        value = value << 8 | next;
    }
    if (unknown || !in.ok())
        return std::nullopt;
    return value;
}

// Where the part ends that a file consists of; nullopt: it does not say.

// A Matroska file is one EBML header and one segment; each has an identifier of four bytes and
// a size.
std::optional<std::uint64_t> end_of_matroska(ByteView beginning) {
    ByteReader in(beginning);
    in.get_bytes(4);
    const std::optional<std::uint64_t> header = read_size(in);
    if (!header || *header > in.rest().size())
        return std::nullopt;
    in.get_bytes(std::size_t(*header) + 4);
    const std::optional<std::uint64_t> segment = read_size(in);
    if (!segment)
        return std::nullopt;
    return beginning.size() - in.rest().size() + *segment;
}

std::optional<std::uint64_t> end_of_avi(ByteView beginning) {
    ByteReader in(beginning);
    in.get_bytes(4);
    const auto size = in.get<std::uint32_t>();
    // Programs that do not know it write nothing, or the largest number.
    constexpr std::uint32_t unknown = 0xffffffff;
    if (!in.ok() || size == 0 || size == unknown)
        return std::nullopt;
    return 8 + std::uint64_t(size);
}

constexpr std::string_view asf_header = "\x30\x26\xb2\x75\x8e\x66\xcf\x11\xa6\xd9";
constexpr std::string_view asf_properties = "\xa1\xdc\xab\x8c\x47\xa9\xcf\x11\x8e\xe4";

// Objects with an identifier of 16 bytes and their size; the first one holds all that describe the
// file.
std::optional<std::uint64_t> end_of_asf(ByteView beginning) {
    constexpr std::size_t head = 24, first = 30;
    ByteReader in(beginning);
    in.get_bytes(first);
    while (in.ok() && in.rest().size() > head) {
        const ByteView name = in.get_bytes(16);
        const auto size = in.get<std::uint64_t>();
        if (size < head || size - head > in.rest().size())
            return std::nullopt;
        ByteReader content(in.get_bytes(std::size_t(size) - head));
        if (!begins(name, asf_properties))
            continue;
        content.get_bytes(16);
        const auto bytes = content.get<std::uint64_t>();
        content.get_bytes(40);
        const auto flags = content.get<std::uint32_t>();
        constexpr std::uint32_t broadcast = 1;  // the size is not known
        return content.ok() && !(flags & broadcast) ? std::optional(bytes) : std::nullopt;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> stated_end(ByteView beginning) {
    if (begins(beginning, "\x1a\x45\xdf\xa3"))
        return end_of_matroska(beginning);
    if (begins(beginning, "RIFF"))
        return end_of_avi(beginning);
    if (begins(beginning, asf_header))
        return end_of_asf(beginning);
    return std::nullopt;
}

}  // namespace

bool is_cut_off(ByteView beginning, std::uint64_t file_bytes) {
    const auto end = stated_end(beginning);
    return end && *end > file_bytes;
}

bool is_cut_off(int descriptor, std::uint64_t file_bytes) {
    std::array<std::byte, cut_off_bytes> beginning;
    const ssize_t count = pread(descriptor, beginning.data(), beginning.size(), 0);
    return count > 0 && is_cut_off(ByteView(beginning).first(std::size_t(count)), file_bytes);
}

}  // namespace theatron::capture
