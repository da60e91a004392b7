// SPDX-License-Identifier: Apache-2.0
// Depth codecs on arrays.
#include <pybind11/stl.h>

#include <mutex>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "encoded.h"
#include "video/depth_codecs.h"

namespace theatron::python {
namespace {

codec::DepthSetting setting_of(const std::string& text,
                               std::string (*missing)(const codec::DepthSetting&)) {
    const codec::ParsedDepthSetting parsed = video::parse_depth_setting(text);
    if (!parsed.problem.empty())
        throw Error(parsed.problem);
    if (const std::string problem = missing(parsed.setting); !problem.empty())
        throw Error(problem);
    return parsed.setting;
}

Error refused(Status status) {
    return Error("The depth image cannot be decoded: it is " + std::string(to_text(status)) + ".");
}

// From several threads of Python, which share its stream.
class DepthEncoding {
public:
    explicit DepthEncoding(const std::string& text)
        : setting_(setting_of(text, video::missing_depth_encoder)),
          encoder_(video::make_depth_encoder(setting_)) {}

    const std::string& codec() const { return setting_.text; }

    EncodedDepthObject encode(const py::object& depth, bool key) {
        const DepthArray array = depth_argument(depth);
        codec::EncodedDepth encoded;
        Bytes bytes;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            bytes.resize(encoder_.max_encoded_size(view_of(array).size));
            encoded = encoder_.encode(view_of(array), number_++, key, bytes);
        }
        return {bytes_of(ByteView(bytes).first(encoded.bytes)), encoded};
    }

private:
    const codec::DepthSetting setting_;
    std::mutex mutex_;  // never taken with Python's lock
    codec::DepthStreamEncoder encoder_;
    FrameNumber number_ = 0;
};

// The same.
class DepthDecoding {
public:
    explicit DepthDecoding(const std::string& text)
        : setting_(setting_of(text, video::missing_depth_decoder)),
          decoder_(video::make_depth_decoder(setting_)) {}

    const std::string& codec() const { return setting_.text; }

    py::array decode(const EncodedDepthObject& encoded) {
        const ByteView data = view_of(encoded.data);
        auto image = std::make_shared<DepthImage>();
        Status status = Status::ok;
        {
            const py::gil_scoped_release released;
            const std::lock_guard lock(mutex_);
            status = read(data, encoded.link, *image);
        }
        if (status != Status::ok)
            throw refused(status);
        const DepthView view = std::as_const(*image).view();
        return array_of(view, std::move(image), true);
    }

private:
    Status read(ByteView data, const codec::FrameLink& link, DepthImage& out) {
        const Result<Size> size = decoder_.read_size(data);
        if (!size)
            return size.error();
        // A few bytes from outside must not take gigabytes.
        if (size->area() > max_depth_pixels)
            return Status::too_large;
        out.resize(*size);
        return decoder_.decode(link, data, out.view());
    }

    const codec::DepthSetting setting_;
    std::mutex mutex_;  // never taken with Python's lock
    codec::DepthStreamDecoder decoder_;
};

EncodedDepthObject make_encoded(const py::bytes& data, FrameNumber frame,
                                std::optional<FrameNumber> reference, int layer, bool key) {
    if (layer < 0 || layer >= codec::max_layers)
        throw py::value_error("layer is 0 to " + std::to_string(codec::max_layers - 1) + ".");
    return {data, {frame, reference.value_or(frame), layer, key}};
}

}  // namespace

void bind_depth_codecs(py::module_& module) {
    using Encoded = EncodedDepthObject;
    py::class_<Encoded>(module, "EncodedDepth",
                        "An encoded depth image and its place in its stream.")
        .def(py::init(&make_encoded), py::arg("data"), py::arg("frame") = 0,
             py::arg("reference") = py::none(), py::arg("layer") = 0, py::arg("key") = true)
        .def_readonly("data", &Encoded::data)
        .def_property_readonly("frame", [](const Encoded& e) { return e.link.frame; })
        .def_property_readonly("reference", [](const Encoded& e) { return e.link.reference_frame; })
        .def_property_readonly("layer", [](const Encoded& e) { return e.link.layer; })
        .def_property_readonly("key", [](const Encoded& e) { return e.link.key; });

    py::class_<DepthEncoding>(module, "DepthEncoder", "Encodes the depth images of one stream.")
        .def(py::init<const std::string&>(), py::arg("codec") = "strata")
        .def_property_readonly("codec", &DepthEncoding::codec)
        .def("encode", &DepthEncoding::encode, py::arg("depth"), py::arg("key") = false,
             "Encodes an array of uint16 of shape (height, width).");

    py::class_<DepthDecoding>(module, "DepthDecoder",
                              "Decodes the depth images of one stream, in order.")
        .def(py::init<const std::string&>(), py::arg("codec") = "strata")
        .def_property_readonly("codec", &DepthDecoding::codec)
        .def("decode", &DepthDecoding::decode, py::arg("encoded"),
             "Returns an array of uint16 of shape (height, width).");

    module.def(
        "encode_depth",
        [](const py::object& depth, const std::string& codec) {
            return DepthEncoding(codec).encode(depth, true).data;
        },
        py::arg("depth"), py::arg("codec") = "strata", "Encodes one depth image by itself.");
    module.def(
        "decode_depth",
        [](const py::bytes& data, const std::string& codec) {
            return DepthDecoding(codec).decode({data, {.key = true}});
        },
        py::arg("data"), py::arg("codec") = "strata", "Decodes what encode_depth() returned.");
    module.def("depth_codecs", &video::depth_codec_names, "The names of all depth codecs.");
}

}  // namespace theatron::python
