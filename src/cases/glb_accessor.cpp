// SPDX-License-Identifier: Apache-2.0
#include "cases/glb_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "cases/foreign_files.h"

namespace theatron::cases::glb {

const Json& meshopt_in(const Json& view) {
    return extension_in(view, has_extension(view, meshopt) ? meshopt : meshopt_successor);
}

namespace {

enum Component : std::size_t {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126
};

// 0: not known.
std::size_t size_of(std::size_t component) {
    switch (component) {
        case i8:
        case u8:
            return 1;
        case i16:
        case u16:
            return 2;
        case u32:
        case f32:
            return 4;
        default:
            return 0;
    }
}

template <class T>
double as(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return double(value);
}

double value_at(const std::byte* at, std::size_t component) {
    switch (component) {
        case i8:
            return as<std::int8_t>(at);
        case u8:
            return as<std::uint8_t>(at);
        case i16:
            return as<std::int16_t>(at);
        case u16:
            return as<std::uint16_t>(at);
        case u32:
            return as<std::uint32_t>(at);
        default:
            return as<float>(at);
    }
}

// The largest value of a type, which stands for 1 in normalized accessors; 1 where nothing changes.
double one_of(std::size_t component) {
    switch (component) {
        case i8:
            return 127;
        case u8:
            return 255;
        case i16:
            return 32'767;
        case u16:
            return 65'535;
        default:
            return 1;
    }
}

}  // namespace

struct Accessors::Numbers {
    std::size_t count = 0, component = f32, components = 1;
    bool normalized = false;
    std::size_t bytes() const { return components * size_of(component); }
    double at(const std::byte* place) const { return scaled(value_at(place, component)); }
    double scaled(double value) const {
        // Floating-point numbers are what they are.
        return normalized && one_of(component) > 1 ? std::max(value / one_of(component), -1.0)
                                                   : value;
    }
};

bool Accessors::has_bytes(std::size_t accessor) const {
    const Json& all = list_of(root_, "accessors");
    return accessor < all.size() && index_of(all[accessor], "bufferView").has_value();
}

Answer Accessors::find(std::size_t accessor, std::size_t components, Numbers& out) {
    const Json& all = list_of(root_, "accessors");
    if (accessor >= all.size())
        return Answer::unreadable;
    const Json& about = all[accessor];
    const auto count = index_of(about, "count");
    out.component = index_of(about, "componentType").value_or(0);
    out.components = components;
    const auto normalized = about.find("normalized");
    out.normalized = normalized != about.end() && *normalized == true;
    if (!count || size_of(out.component) == 0 ||
        text_of(about, "type") != (components == 3 ? "VEC3" : "SCALAR"))
        return Answer::unreadable;
    if (*count > max_loose_vertices)
        return Answer::too_large;
    out.count = *count;
    return Answer::content;
}

// The bytes of a buffer's view from the holder's offset on, of which `needed` must be there.
Answer Accessors::find_view(const Json& holder, std::size_t needed, ByteView& bytes,
                            std::size_t& stride) {
    const Json& views = list_of(root_, "bufferViews");
    const auto number = index_of(holder, "bufferView");
    if (!number || *number >= views.size())
        return Answer::unreadable;
    const Json& view = views[*number];
    stride = index_of(view, "byteStride").value_or(0);
    ByteView whole;
    Answer found = Answer::content;
    // Packed bytes are in the extension's own buffer; this one may have none.
    if (const Json& packed = meshopt_in(view); packed.is_object())
        found = unpack_view(*number, packed, whole, stride);
    else
        found = find_bytes(view, whole);
    if (found != Answer::content)
        return found;
    const std::size_t offset = index_of(holder, "byteOffset").value_or(0);
    if (offset > whole.size() || needed > whole.size() - offset)
        return Answer::lacks;
    bytes = whole.subspan(offset);
    return Answer::content;
}

// The place in the buffer that a view names; an object of the extension is as one.
Answer Accessors::find_bytes(const Json& place, ByteView& bytes) {
    ByteView buffer;
    if (const Answer found = buffers_.find(index_of(place, "buffer").value_or(0), buffer);
        found != Answer::content)
        return found;
    const std::size_t begin = index_of(place, "byteOffset").value_or(0);
    const std::size_t length = index_of(place, "byteLength").value_or(0);
    if (begin > buffer.size() || length > buffer.size() - begin)
        return Answer::lacks;
    bytes = buffer.subspan(begin, length);
    return Answer::content;
}

// Several accessors may use one view, which is unpacked once.
Answer Accessors::unpack_view(std::size_t number, const Json& packed, ByteView& bytes,
                              std::size_t& stride) {
    const MeshoptView about{text_of(packed, "mode"), text_of(packed, "filter"),
                            index_of(packed, "count").value_or(0),
                            index_of(packed, "byteStride").value_or(0)};
    if (about.mode == "ATTRIBUTES")
        stride = about.stride;
    const auto known = unpacked_.find(number);
    if (known != unpacked_.end()) {
        bytes = known->second;
        return Answer::content;
    }
    ByteView from;
    if (const Answer found = find_bytes(packed, from); found != Answer::content)
        return found;
    if (needs_newer_meshopt(from, about)) {
        extension_ = std::string(meshopt_successor) + ", version 1";
        return Answer::extension;
    }
    std::optional<Bytes> content = unpack_meshopt(from, about);
    if (!content)
        return Answer::compression;
    unpacked_bytes_ += content->size();
    if (unpacked_bytes_ > max_unpacked_view_bytes)
        return Answer::too_large;
    bytes = unpacked_[number] = std::move(*content);
    return Answer::content;
}

Answer Accessors::read_draco(const Json& packed, std::size_t position, RawMesh& out) {
    if (!unpack_draco_) {
        extension_ = draco;
        return Answer::extension;
    }
    Numbers about;
    if (const Answer found = find(position, 3, about); found != Answer::content)
        return found;
    ByteView bytes;
    std::size_t stride = 0;
    if (const Answer found = find_view(packed, 0, bytes, stride); found != Answer::content)
        return found;
    const Json& attributes = packed.contains("attributes") ? packed["attributes"] : no_list();
    const auto number = index_of(attributes, "POSITION");
    if (!number || *number > std::numeric_limits<std::uint32_t>::max())
        return Answer::unreadable;
    std::optional<RawMesh> mesh = unpack_draco_(bytes, std::uint32_t(*number));
    if (!mesh)
        return Answer::compression;
    if (mesh->corners.size() > max_loose_vertices)
        return Answer::too_large;
    if (mesh->corners.size() < about.count)
        return Answer::lacks;
    for (Vec3& corner : mesh->corners)
        corner = {about.scaled(corner.x), about.scaled(corner.y), about.scaled(corner.z)};
    out = std::move(*mesh);
    return Answer::content;
}

Answer Accessors::replace_sparse(const Json& accessor, const Numbers& about,
                                 std::vector<double>& values) {
    const auto found = accessor.find("sparse");
    if (found == accessor.end())
        return Answer::content;
    const Json& sparse = *found;
    Numbers indices{index_of(sparse, "count").value_or(0)};
    if (!sparse.is_object() || indices.count > about.count || !sparse.contains("indices") ||
        !sparse.contains("values"))
        return Answer::unreadable;
    indices.component = index_of(sparse["indices"], "componentType").value_or(0);
    if (size_of(indices.component) == 0 || indices.component == f32)
        return Answer::unreadable;
    ByteView places, content;
    std::size_t stride = 0;
    if (const Answer view =
            find_view(sparse["indices"], indices.count * indices.bytes(), places, stride);
        view != Answer::content)
        return view;
    if (const Answer view =
            find_view(sparse["values"], indices.count * about.bytes(), content, stride);
        view != Answer::content)
        return view;
    for (std::size_t i = 0; i < indices.count; ++i) {
        const double place = indices.at(places.data() + i * indices.bytes());
        if (!(place >= 0 && place < double(about.count)))
            return Answer::unreadable;
        for (std::size_t k = 0; k < about.components; ++k)
            values[std::size_t(place) * about.components + k] =
                about.at(content.data() + i * about.bytes() + k * size_of(about.component));
    }
    return Answer::content;
}

Answer Accessors::read(std::size_t accessor, std::size_t components, std::vector<double>& out) {
    Numbers about;
    if (const Answer found = find(accessor, components, about); found != Answer::content)
        return found;
    const Json& json = list_of(root_, "accessors")[accessor];
    out.assign(about.count * components, 0);
    if (about.count == 0)
        return Answer::content;
    if (json.contains("bufferView")) {
        ByteView bytes;
        std::size_t stride = 0;
        if (const Answer view = find_view(json, about.bytes(), bytes, stride);
            view != Answer::content)
            return view;
        if (stride != 0 && stride < about.bytes()) {
            extension_ = "byteStride";
            return Answer::property;
        }
        stride = std::max(stride, about.bytes());
        if ((bytes.size() - about.bytes()) / stride < about.count - 1)
            return Answer::lacks;
        for (std::size_t i = 0; i < about.count; ++i)
            for (std::size_t k = 0; k < components; ++k)
                out[i * components + k] =
                    about.at(bytes.data() + i * stride + k * size_of(about.component));
    }
    return replace_sparse(json, about, out);
}

Answer Accessors::read_positions(std::size_t accessor, std::vector<Vec3>& out) {
    std::vector<double> numbers;
    const Answer found = read(accessor, 3, numbers);
    for (std::size_t i = 0; found == Answer::content && i + 2 < numbers.size(); i += 3)
        out.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return found;
}

Answer Accessors::read_indices(std::size_t accessor, std::vector<std::uint32_t>& out) {
    std::vector<double> numbers;
    const Answer found = read(accessor, 1, numbers);
    if (found != Answer::content)
        return found;
    for (const double number : numbers) {
        if (!(number >= 0 && number <= 4294967295.0))
            return Answer::unreadable;
        out.push_back(std::uint32_t(number));
    }
    return found;
}

}  // namespace theatron::cases::glb
