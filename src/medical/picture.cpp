// SPDX-License-Identifier: Apache-2.0
#include "medical/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::medical {
namespace {

constexpr std::uint32_t picture_magic = 0x49504854;  // "THPI"
constexpr std::uint8_t picture_version = 1;
constexpr std::uint8_t one_grey = 1, three_colors = 3;  // bytes of a pixel

bool is_grey(ColorView picture) {
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const Rgb p = picture.row(y)[x];
            if (p.r != p.g || p.g != p.b)
                return false;
        }
    return true;
}

// The share of each of `from` pixels in each of `to` pixels, fewer, of the same line.
struct Shares {
    struct Share {
        int from = 0;
        std::vector<float> weights;  // of the pixels from there on; their sum is 1
    };
    std::vector<Share> of;

    Shares(int from, int to) {
        const double ratio = double(from) / to;
        for (int i = 0; i < to; ++i) {
            const double low = i * ratio, high = std::min((i + 1) * ratio, double(from));
            Share share{int(low), {}};
            for (int k = share.from; k < from && k < high; ++k)
                share.weights.push_back(
                    float((std::min(high, k + 1.0) - std::max(low, double(k))) / (high - low)));
            of.push_back(std::move(share));
        }
    }
};

struct Sum {
    float r = 0, g = 0, b = 0;
    void add(float weight, Sum other) {
        r += weight * other.r;
        g += weight * other.g;
        b += weight * other.b;
    }
};

std::uint8_t rounded_level(float value) {
    return std::uint8_t(std::clamp(std::lround(value), 0L, 255L));
}

}  // namespace

bool is_picture_size(Size size) {
    return size.width > 0 && size.width <= max_picture_side && size.height > 0 &&
           size.height <= max_picture_side;
}

Bytes encode_picture(ColorView picture) {
    assert(is_picture_size(picture.size));
    const std::uint8_t channels = is_grey(picture) ? one_grey : three_colors;
    Bytes bytes;
    bytes.reserve(16 + channels * picture.size.area());
    ByteWriter out(bytes);
    out.put(picture_magic);
    out.put(picture_version);
    out.put(channels);
    out.put(std::uint16_t(0));
    out.put(std::uint32_t(picture.size.width));
    out.put(std::uint32_t(picture.size.height));
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const Rgb p = picture.row(y)[x];
            bytes.push_back(std::byte(p.r));
            if (channels == three_colors) {
                bytes.push_back(std::byte(p.g));
                bytes.push_back(std::byte(p.b));
            }
        }
    return bytes;
}

Result<ColorImage> decode_picture(ByteView bytes) {
    ByteReader in(bytes);
    const bool is_picture = in.get<std::uint32_t>() == picture_magic;
    const auto found_version = in.get<std::uint8_t>();
    const auto channels = in.get<std::uint8_t>();
    const auto zero = in.get<std::uint16_t>();
    const auto width = in.get<std::uint32_t>(), height = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (!is_picture)
        return Status::malformed;
    if (found_version != picture_version)
        return found_version > picture_version ? Status::unsupported_version : Status::malformed;
    if (width > std::uint32_t(max_picture_side) || height > std::uint32_t(max_picture_side))
        return Status::too_large;
    const Size size{int(width), int(height)};
    if (!is_picture_size(size) || (channels != one_grey && channels != three_colors) || zero != 0)
        return Status::malformed;
    const std::size_t needed = channels * size.area();
    if (in.rest().size() != needed)
        return in.rest().size() < needed ? Status::truncated : Status::trailing_bytes;
    ColorImage picture(size);
    const std::byte* at = in.rest().data();
    const int next = channels == three_colors ? 1 : 0;
    for (Rgb& p : picture.pixels) {
        p = {std::uint8_t(at[0]), std::uint8_t(at[next]), std::uint8_t(at[2 * next])};
        at += channels;
    }
    return picture;
}

ColorImage reduced(ColorImage picture, int max_side) {
    const int longer = std::max(picture.size.width, picture.size.height);
    if (longer <= max_side)
        return picture;
    const auto shorter = [&](int side) {
        return std::max(1, int(std::lround(double(side) * max_side / longer)));
    };
    ColorImage small({shorter(picture.size.width), shorter(picture.size.height)});
    const Shares columns(picture.size.width, small.size.width),
        rows(picture.size.height, small.size.height);
    std::vector<Sum> line(std::size_t(small.size.width));
    for (int y = 0; y < small.size.height; ++y) {
        std::fill(line.begin(), line.end(), Sum{});
        const Shares::Share& of_row = rows.of[std::size_t(y)];
        for (std::size_t k = 0; k < of_row.weights.size(); ++k) {
            const Rgb* from = picture.view().row(of_row.from + int(k));
            for (std::size_t x = 0; x < line.size(); ++x) {
                const Shares::Share& of_column = columns.of[x];
                Sum sum;
                for (std::size_t i = 0; i < of_column.weights.size(); ++i) {
                    const Rgb p = from[std::size_t(of_column.from) + i];
                    sum.add(of_column.weights[i], {float(p.r), float(p.g), float(p.b)});
                }
                line[x].add(of_row.weights[k], sum);
            }
        }
        for (std::size_t x = 0; x < line.size(); ++x)
            small.view().row(y)[x] = {rounded_level(line[x].r), rounded_level(line[x].g),
                                      rounded_level(line[x].b)};
    }
    return small;
}

}  // namespace theatron::medical
