// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_file_native.h"

#include <turbojpeg.h>

#include <memory>
#include <vector>

#include "base/error.h"
#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

struct Destroy {
    void operator()(void* handle) const { tjDestroy(handle); }
};

// Programs of Adobe and those after them store how much paper is left of each ink.
bool stores_paper(ByteView jpeg) {
    ByteReader in(jpeg);
    in.get_bytes(2);  // start of image
    while (true) {
        const auto segment = next_jpeg_segment(in);
        if (!segment || segment->marker == jpeg_marker::start_of_scan)
            return false;
        if (segment->marker == jpeg_marker::adobe)
            return true;
    }
}

}  // namespace

Status decode_jpeg_file(ByteView jpeg, ColorImage& out) {
    const std::unique_ptr<void, Destroy> handle(tjInitDecompress());
    if (!handle)
        throw Error("libjpeg-turbo gives no decoder; is memory exhausted?");
    const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
    const auto count = static_cast<unsigned long>(jpeg.size());
    Size size;
    int subsampling = 0, colors = 0;
    if (tjDecompressHeader3(handle.get(), bytes, count, &size.width, &size.height, &subsampling,
                            &colors))
        return Status::malformed;
    if (!is_valid(size))
        return Status::too_large;
    out.resize(size);
    const bool has_inks = colors == TJCS_CMYK || colors == TJCS_YCCK;
    const int pixel_bytes = has_inks ? 4 : 3;
    std::vector<unsigned char> inks(has_inks ? size.area() * 4 : 0);
    auto* const to = has_inks ? inks.data() : reinterpret_cast<unsigned char*>(out.pixels.data());
    if (tjDecompress2(handle.get(), bytes, count, to, size.width, size.width * pixel_bytes,
                      size.height, has_inks ? TJPF_CMYK : TJPF_RGB,
                      TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS))
        return Status::malformed;
    if (!has_inks)
        return Status::ok;
    const bool is_paper = stores_paper(jpeg);
    for (std::size_t i = 0; i < size.area(); ++i) {
        const auto paper = [&](std::size_t ink) {
            return is_paper ? inks[4 * i + ink] : 255 - inks[4 * i + ink];
        };
        const auto mixed = [&](std::size_t ink) {
            return std::uint8_t((paper(ink) * paper(3) + 127) / 255);
        };
        out.pixels[i] = {mixed(0), mixed(1), mixed(2)};
    }
    return Status::ok;
}

}  // namespace theatron::video
