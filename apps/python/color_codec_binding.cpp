// SPDX-License-Identifier: Apache-2.0
// Colour codecs on arrays.
#include <pybind11/stl.h>

#include <mutex>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "encoded.h"
#include "video/color_codec.h"

namespace theatron::python {
namespace {

video::ColorSetting setting_of(const std::string& text,
                               std::string (*missing)(const video::ColorSetting&)) {
    const video::ParsedColorSetting parsed = video::parse_color_setting(text);
    if (!parsed.problem.empty())
        throw Error(parsed.problem);
    if (const std::string problem = missing(parsed.setting); !problem.empty())
        throw Error(problem);
    return parsed.setting;
}

// From several threads of Python, which share its stream.
class ColorEncoding {
public:
    explicit ColorEncoding(const std::string& text)
        : setting_(setting_of(text, video::missing_color_encoder)),
          encoder_(video::make_color_encoder(setting_)) {}

    const std::string& codec() const { return setting_.text; }

    EncodedColorObject encode(const py::object& color, bool key) {
        const ColorArray array = color_argument(color);
        EncodedColorObject object;
        Bytes bytes;
        Status status = Status::ok;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            const ColorView view = view_of(array);
            picture_.pixels.resize(view.size);
            picture_.size = view.size;
            copy_pixels(view, picture_.pixels.view());
            const auto encoded = encoder_->encode(picture_, key);
            status = encoded ? Status::ok : encoded.error();
            if (encoded) {
                bytes.assign(encoded->bytes.begin(), encoded->bytes.end());
                object.key = encoded->key;
            }
        }
        if (status != Status::ok)
            throw Error("The colour picture cannot be encoded as '" + setting_.text + "': it is " +
                        std::string(to_text(status)) + ".");
        object.data = bytes_of(bytes);
        return object;
    }

private:
    const video::ColorSetting setting_;
    std::mutex mutex_;  // never taken with Python's lock; guards all below
    std::unique_ptr<video::ColorEncoder> encoder_;
    ColorData picture_;
};

// The same.
class ColorDecoding {
public:
    explicit ColorDecoding(const std::string& text)
        : setting_(setting_of(text, video::missing_color_decoder)),
          decoder_(video::make_color_decoder(setting_.id)) {}

    const std::string& codec() const { return setting_.text; }

    py::array decode(const py::bytes& data) {
        const ByteView bytes = view_of(data);
        auto image = std::make_shared<ColorImage>();
        Status status = Status::ok;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            status = read(bytes, *image);
        }
        if (status != Status::ok)
            throw Error("The colour picture cannot be decoded: it is " +
                        std::string(to_text(status)) + ".");
        const ColorView view = std::as_const(*image).view();
        return array_of(view, std::move(image), true);
    }

private:
    Status read(ByteView data, ColorImage& out) {
        const Result<Size> size = video::read_color_size(setting_.id, data);
        if (!size)
            return size.error();
        // A few bytes from outside must not take gigabytes.
        if (size->area() > max_color_pixels)
            return Status::too_large;
        if (const Status status = decoder_->submit(data, number_++); status != Status::ok)
            return status;
        Status status = Status::malformed;
        while (auto decoded = decoder_->poll()) {
            out = std::move(decoded->image);
            status = Status::ok;
        }
        return status;
    }

    const video::ColorSetting setting_;
    std::mutex mutex_;  // never taken with Python's lock; guards all below
    std::unique_ptr<video::ColorDecoder> decoder_;
    FrameNumber number_ = 0;
};

}  // namespace

void bind_color_codecs(py::module_& module) {
    py::class_<EncodedColorObject>(module, "EncodedColor", "An encoded colour picture.")
        .def_readonly("data", &EncodedColorObject::data)
        .def_readonly("key", &EncodedColorObject::key);
    py::class_<ColorEncoding>(module, "ColorEncoder", "Encodes the colour pictures of one stream.")
        .def(py::init<const std::string&>(), py::arg("codec") = "jpeg:quality=85")
        .def_property_readonly("codec", &ColorEncoding::codec)
        .def("encode", &ColorEncoding::encode, py::arg("color"), py::arg("key") = false,
             "Encodes an array of uint8 of shape (height, width, 3), sRGB.");
    py::class_<ColorDecoding>(module, "ColorDecoder",
                              "Decodes the colour pictures of one stream, in order.")
        .def(py::init<const std::string&>(), py::arg("codec") = "jpeg:quality=85")
        .def_property_readonly("codec", &ColorDecoding::codec)
        .def("decode", &ColorDecoding::decode, py::arg("data"),
             "Returns an array of uint8 of shape (height, width, 3), sRGB.");
    module.def("color_codecs", &video::color_codec_names, "The names of all colour codecs.");
}

}  // namespace theatron::python
