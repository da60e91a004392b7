// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_scan.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "video/jpeg_header.h"
#include "video/jpeg_pixels.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "video/jpeg_scan.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#if HWY_TARGET != HWY_SCALAR
// In this order, which is that of decoding.
#include "video/jpeg_bits-inl.h"

#include "video/jpeg_samples-inl.h"

#include "video/jpeg_colors-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg_scan::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// No processor of interest has vectors of less than 128 bits.
Status decode(const Scan&) {
    return Status::unsupported;
}

#else

class Decoder {
public:
    explicit Decoder(const Scan& scan) : scan_(scan), jpeg_(*scan.jpeg) {
        std::memset(scan.coefficients, 0, sizeof(std::int16_t) * max_group_quads * quad_values);
        const int across = 1 << jpeg_.chroma_shift_x, down = 1 << jpeg_.chroma_shift_y;
        std::size_t count = 0;
        for (int unit = 0; unit < group_units; ++unit) {
            for (int y = 0; y < down; ++y)
                for (int x = 0; x < across; ++x)
                    plan(count++, 0, y * across, unit * across + x);
            for (int i = 1; i < 3; ++i)
                plan(count++, std::size_t(i), across * down + i - 1, unit);
        }
        unit_blocks_ = count / group_units;
        for (std::size_t i = 0; i < count; ++i) {
            const Component& next = *plan_.components[(i + 1) % count];
            plan_.change[i] = plan_.inside[i] ^ std::uintptr_t(scan.lookup->start(next.lookup));
        }
    }

    Status run() {
        begin_interval(0);
        const auto [columns, rows] = jpeg_.units();
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; column += group_units) {
                const int count = std::min(group_units, columns - column);
                if (!read_group(count))
                    return Status::malformed;
                transform_group(column / group_units);
            }
            put_rows(row, row + 1 == rows);
        }
        const bool is_whole = bits_.taken(scan_.bits) <= 8 * interval_.size;
        return is_whole && ends_as_jpeg(jpeg_.coded, interval_.end) ? Status::ok
                                                                    : Status::malformed;
    }

private:
    void plan(std::size_t i, std::size_t component, int first_quad, int column) {
        const Component& from = scan_.components[component];
        plan_.blocks[i] = scan_.coefficients + (first_quad + column / quad_blocks) * quad_values +
                          column % quad_blocks * 8;
        plan_.components[i] = &from;
        plan_.inside[i] = std::uintptr_t(scan_.lookup->inside(from.lookup));
    }

    void begin_interval(std::size_t from) {
        interval_ = unstuff(jpeg_.coded, from, scan_.bits);
        bits_ = Bits(scan_.bits);
        last_dc_ = {};
        units_left_ =
            jpeg_.restart_interval > 0 ? jpeg_.restart_interval : std::numeric_limits<int>::max();
    }

    bool restart() {
        const int expected = jpeg_marker::first_restart + restarts_++ % 8;
        if (interval_.end.code != expected || bits_.taken(scan_.bits) > 8 * interval_.size)
            return false;
        begin_interval(interval_.end.after);
        return true;
    }

    bool read_group(int units) {
        std::size_t i = 0;
        while (units > 0) {
            if (units_left_ == 0 && !restart())
                return false;
            const int count = std::min(units, units_left_);
            const std::size_t last = i + std::size_t(count) * unit_blocks_;
            // Reading ahead may go a few bytes further than reading.
            const std::uint8_t* const limit = scan_.bits + interval_.size + sizeof(std::uint64_t);
            if (!read_blocks(bits_, plan_, *scan_.lookup, i, last, limit))
                return false;
            for (; i < last; ++i) {
                const Component& component = *plan_.components[i];
                std::uint32_t& dc = last_dc_[std::size_t(&component - scan_.components.data())];
                std::int16_t* const block = plan_.blocks[i];
                dc += std::uint32_t(block[0]);
                block[0] = jpeg_pixels::scaled_dc(dc, component.dc_step);
            }
            units -= count;
            units_left_ -= count;
        }
        return true;
    }

    void transform_group(int group) {
        std::int16_t* quad = scan_.coefficients;
        for (std::size_t i = 0; i < 3; ++i) {
            const int across = i == 0 ? 1 << jpeg_.chroma_shift_x : 1;
            const int down = i == 0 ? 1 << jpeg_.chroma_shift_y : 1;
            const Component& component = scan_.components[i];
            for (int y = 0; y < down; ++y)
                for (int x = 0; x < across; ++x, quad += quad_values)
                    transform_quad(quad, component,
                                   component.strip.row(8 * y) + (group * across + x) * quad_row);
        }
    }

    // Turns the strips into pixels. With halved rows a pixel needs chroma from
    // above and below: the last row of pixels waits for the next strip.
    void put_rows(int row, bool is_last) {
        const int height = jpeg_.unit().height, shift = jpeg_.chroma_shift_y;
        const int first = row * height;
        const int begin = std::max(first - shift, 0);
        const int end = is_last ? jpeg_.size.height : first + height - shift;
        for (int y = begin; y < end; ++y) {
            const std::uint8_t* luma = scan_.components[0].strip.row(y - first);
            const int near = y >> shift;
            const int beyond = near + (y % 2 ? 1 : -1);
            const int far = shift ? std::clamp(beyond, 0, jpeg_.chroma_size().height - 1) : near;
            const int first_chroma = row * 8;
            std::array<const std::uint8_t*, 2> chroma;
            for (std::size_t i = 0; i < 2; ++i) {
                const Strip& strip = scan_.components[i + 1].strip;
                chroma[i] = strip.row(near - first_chroma);
                if (jpeg_.chroma_shift_x)
                    sum_columns(chroma[i], strip.row(far - first_chroma), jpeg_.chroma_size().width,
                                scan_.sums[i]);
            }
            if (jpeg_.chroma_shift_x)
                put_pixels(luma, HalvedChroma(scan_.sums), jpeg_.size.width, scan_.out.row(y));
            else
                put_pixels(luma, FullChroma(chroma), jpeg_.size.width, scan_.out.row(y));
        }
        if (shift)
            for (std::size_t i = 0; i < 3; ++i) {
                const Strip& strip = scan_.components[i].strip;
                const int last_row = (i == 0 ? height : 8) - 1;
                std::memcpy(strip.row(-1), strip.row(last_row),
                            std::size_t(strip.stride - 2 * margin));
            }
    }

    const Scan& scan_;
    const BaselineJpeg& jpeg_;
    Plan plan_;
    std::size_t unit_blocks_ = 0;
    Interval interval_;
    Bits bits_{scan_.bits};
    std::array<std::uint32_t, 3> last_dc_{};
    int units_left_ = 0, restarts_ = 0;
};

Status decode(const Scan& scan) {
    return Decoder(scan).run();
}

#endif

}  // namespace theatron::video::jpeg_scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::video::jpeg_scan {

HWY_EXPORT(decode);

Status decode(const Scan& scan) {
    return HWY_DYNAMIC_DISPATCH(decode)(scan);
}

}  // namespace theatron::video::jpeg_scan
#endif
