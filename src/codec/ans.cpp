// SPDX-License-Identifier: Apache-2.0
#include "codec/ans.h"

#include <algorithm>
#include <cassert>

#include "codec/payload_header.h"
#include "codec/rows.h"

namespace theatron::codec::ans {
namespace {

// Splits the values into runs and differences. Runs of zeros and of non-zero values
// alternate, zeros first; the last run may be of either kind. A difference is the
// zigzagged change since the non-zero value before.
void split(std::span<const std::uint16_t> values, DepthWorkspace& work) {
    work.runs.resize(values.size() + 1);
    work.differences.resize(values.size());
    std::uint32_t* run = work.runs.data();
    std::uint32_t* difference = work.differences.data();
    std::uint16_t previous = 0;
    for (std::size_t at = 0; at < values.size();) {
        const std::size_t begin = at;
        while (at < values.size() && values[at] == 0)
            ++at;
        *run++ = std::uint32_t(at - begin);
        if (at == values.size())
            break;
        const std::size_t first = at;
        for (; at < values.size() && values[at] != 0; previous = values[at++])
            *difference++ = zigzag(std::uint16_t(values[at] - previous));
        *run++ = std::uint32_t(at - first);
    }
    work.run_count = std::size_t(run - work.runs.data());
    work.difference_count = std::size_t(difference - work.differences.data());
}

// The number of non-zero values according to the runs. Malformed unless they cover
// exactly `count` values.
Result<std::size_t> count_differences(std::span<const std::uint32_t> runs, std::size_t count) {
    std::size_t covered = 0, measured = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if ((runs[i] == 0 && i > 0) || runs[i] > count - covered)
            return Status::malformed;
        covered += runs[i];
        measured += i % 2 ? runs[i] : 0;
    }
    if (covered != count)
        return Status::malformed;
    return measured;
}

Status join(std::span<const std::uint32_t> runs, std::span<const std::uint32_t> differences,
            std::uint16_t* out) {
    const std::uint32_t* difference = differences.data();
    std::uint16_t previous = 0;
    bool zero_seen = false;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (i % 2 == 0) {
            std::memset(out, 0, 2 * std::size_t(runs[i]));
            out += runs[i];
            continue;
        }
        for (std::uint32_t n = runs[i]; n > 0; --n) {
            previous = std::uint16_t(previous + unzigzag(std::uint16_t(*difference++)));
            zero_seen |= previous == 0;
            *out++ = previous;
        }
    }
    return zero_seen ? Status::malformed : Status::ok;
}

}  // namespace

std::size_t max_encoded_size(Size size) {
    // At most one difference per pixel, and one run per pixel and one more.
    return payload_header_size + 4 + max_encoded_numbers(size.area()) +
           max_encoded_numbers(size.area() + 1);
}

std::size_t encode(DepthView depth, DepthView reference, DepthWorkspace& work,
                   std::span<std::byte> out) {
    const bool delta = reference.pixels != nullptr;
    assert(is_valid(depth.size) && (!delta || reference.size == depth.size));
    assert(out.size() >= max_encoded_size(depth.size));
    work.values.resize(depth.size.area());
    const MutableDepthView coded{work.values.data(), depth.size};
    if (delta)
        subtract_rows(depth, reference, coded);
    else
        copy_rows(depth, coded);
    split(work.values, work);
    const std::span runs(work.runs.data(), work.run_count);
    const std::span differences(work.differences.data(), work.difference_count);

    put_header({.codec = DepthCodecId::ans, .delta = delta, .size = depth.size}, out.data());
    std::size_t used = payload_header_size;
    store_le(out.data() + used, std::uint32_t(runs.size()));
    used += 4;
    used += encode_runs(runs, work.coder, out.subspan(used));
    used += encode_differences(differences, work.coder, out.subspan(used));
    return used;
}

Result<Size> read_size(ByteView encoded) {
    const auto header = read_header(encoded, DepthCodecId::ans, true);
    if (!header)
        return header.error();
    return header->size;
}

Status decode(ByteView encoded, DepthView reference, DepthWorkspace& work, MutableDepthView out) {
    const auto header = read_header(encoded, DepthCodecId::ans, true);
    if (!header)
        return header.error();
    if (header->size != out.size)
        return Status::size_mismatch;
    if (header->delta && (reference.pixels == nullptr || reference.size != out.size))
        return Status::missing_reference;

    const std::size_t area = out.size.area();
    ByteView in = encoded.subspan(payload_header_size);
    if (in.size() < 4)
        return Status::truncated;
    const auto run_count = load_le<std::uint32_t>(in.data());
    in = in.subspan(4);
    if (run_count > area + 1)
        return Status::malformed;
    work.runs.resize(area + 1);
    const std::span runs(work.runs.data(), run_count);
    if (const Status status = decode_runs(in, work.coder, runs); status != Status::ok)
        return status;
    const auto measured = count_differences(runs, area);
    if (!measured)
        return measured.error();
    work.differences.resize(area);
    const std::span differences(work.differences.data(), *measured);
    if (const Status status = decode_differences(in, work.coder, differences); status != Status::ok)
        return status;
    if (!in.empty())
        return Status::trailing_bytes;

    work.values.resize(area);
    if (const Status status = join(runs, differences, work.values.data()); status != Status::ok)
        return status;
    const MutableDepthView coded{work.values.data(), out.size};
    if (header->delta)
        add_rows(coded, reference, out);
    else
        copy_rows(coded, out);
    return Status::ok;
}

}  // namespace theatron::codec::ans
