// SPDX-License-Identifier: Apache-2.0
#include "face/ict_head.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

constexpr std::string_view shapes_magic = "ICTFKL01";
constexpr std::size_t most_corners = 16;
constexpr float mm_per_cm = 10;
// The cornea is the white's middle in its texture, which is clear: the iris lies behind it.
constexpr float cornea_radius = 0.1F;
constexpr std::uint32_t no_vertex = 0xffffffff;
constexpr float most_mm = 1000;

struct Material {
    std::string_view name;
    std::optional<HeadPart> part;  // nullopt: left out
};
constexpr Material materials[] = {
    {"M_Face", HeadPart::skin},
    {"M_BackHead", HeadPart::head},
    {"M_GumsTongue", HeadPart::gums},
    {"M_Teeth", HeadPart::teeth},
    {"M_ScleraLeft", HeadPart::sclera},
    {"M_ScleraRight", HeadPart::sclera},
    {"M_IrisLeft", HeadPart::iris},
    {"M_IrisRight", HeadPart::iris},
    // Lashes are slabs without their texture's transparency.
    {"M_EyeLashes", std::nullopt},
    {"M_LacrimalFluid", std::nullopt},
    {"M_EyeBlend", std::nullopt},
    {"M_EyeOcclusion", std::nullopt},
};

// The next word of a line, or nothing at its end.
std::string_view next_word(std::string_view& line) {
    const std::size_t first = std::min(line.find_first_not_of(" \t\r"), line.size());
    line.remove_prefix(first);
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    line.remove_prefix(word.size());
    return word;
}

bool read_number(std::string_view word, float& value) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    value = float(number);
    return error == std::errc() && end == word.data() + word.size() && std::fabs(number) <= most_mm;
}

class MeshReader {
public:
    std::string problem;
    MorphModel model;                       // without shapes and landmarks
    std::vector<std::uint32_t> of_mesh;     // the vertex of the mesh that each of the model's is
    std::vector<std::uint32_t> first_copy;  // of each vertex of the mesh; no_vertex: of no triangle
    std::size_t read_vertices() const { return corners_.size(); }

    bool read(std::string_view text) {
        for (std::size_t number = 1; !text.empty(); ++number) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            if (!read_line(text.substr(0, end))) {
                problem = "line " + std::to_string(number) + " of its mesh " + problem;
                return false;
            }
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return finish();
    }

private:
    bool refuse(const char* why) {
        problem = why;
        return false;
    }

    bool read_line(std::string_view line) {
        const std::string_view kind = next_word(line);
        if (kind == "v") {
            std::array<float, 3> corner{};
            for (float& value : corner) {
                if (!read_number(next_word(line), value))
                    return refuse("is no vertex");
                value *= mm_per_cm;
                if (std::fabs(value) > most_mm)
                    return refuse("is a vertex too far away");
            }
            corners_.push_back(corner);
            return corners_.size() <= max_vertices || refuse("is a vertex too many");
        }
        if (kind == "vt") {
            std::array<float, 2> place{};
            for (float& value : place)
                if (!read_number(next_word(line), value))
                    return refuse("is no place in a texture");
            places_.push_back(place);
            return places_.size() <= 2 * std::size_t(max_vertices) ||
                   refuse("is a place in a texture too many");
        }
        if (kind == "usemtl") {
            const std::string_view name = next_word(line);
            const auto* found =
                std::find_if(std::begin(materials), std::end(materials),
                             [&](const Material& material) { return material.name == name; });
            if (found == std::end(materials))
                return refuse("names a material that ICT-FaceKit Light does not have");
            part_ = found->part;
            return true;
        }
        return kind != "f" || read_polygon(line);
    }

    bool read_polygon(std::string_view line) {
        std::vector<std::uint32_t> polygon;
        bool is_clear = part_ == HeadPart::sclera;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
            std::uint32_t corner = 0, place = 0;
            const char* const end = word.data() + word.size();
            const auto first = std::from_chars(word.data(), end, corner);
            if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/')
                return refuse("is a polygon without places in a texture");
            const auto second = std::from_chars(first.ptr + 1, end, place);
            if (second.ec != std::errc() || corner < 1 || corner > corners_.size() || place < 1 ||
                place > places_.size())
                return refuse("is a polygon whose corners are not there");
            if (polygon.size() == most_corners)
                return refuse("is a polygon with too many corners");
            const auto& at = places_[place - 1];
            is_clear = is_clear && std::hypot(at[0] - 0.5F, at[1] - 0.5F) < cornea_radius;
            if (part_)
                polygon.push_back(vertex_of(corner - 1, place - 1));
        }
        if (is_clear)
            return true;
        auto& triangles = of_part_[std::size_t(part_.value_or(HeadPart::skin))];
        for (std::size_t i = 2; i < polygon.size(); ++i)
            triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
        count_ += polygon.size() < 3 ? 0 : polygon.size() - 2;
        return (count_ <= max_triangles && of_mesh.size() <= max_vertices) ||
               refuse("has a triangle too many");
    }

    // Only on the skin does another place in the texture make another vertex.
    std::uint32_t vertex_of(std::uint32_t corner, std::uint32_t place) {
        first_copy.resize(corners_.size(), no_vertex);
        if (part_ != HeadPart::skin && first_copy[corner] != no_vertex)
            return first_copy[corner];
        const auto [at, is_new] =
            copies_.try_emplace({corner, place}, std::uint32_t(of_mesh.size()));
        if (!is_new)
            return at->second;
        of_mesh.push_back(corner);
        if (first_copy[corner] == no_vertex)
            first_copy[corner] = at->second;
        model.neutral.insert(model.neutral.end(), corners_[corner].begin(), corners_[corner].end());
        // Parts lie beside each other in u.
        const auto [u, v] = places_[place];
        model.places.push_back(u - std::floor(u));
        model.places.push_back(std::clamp(1 - v, 0.F, 1.F));
        return at->second;
    }

    bool finish() {
        first_copy.resize(corners_.size(), no_vertex);
        for (std::size_t i = 0; i < part_count; ++i) {
            model.part_sizes[i] = std::uint32_t(of_part_[i].size());
            model.triangles.insert(model.triangles.end(), of_part_[i].begin(), of_part_[i].end());
        }
        if (of_part_[std::size_t(HeadPart::skin)].empty())
            return refuse("its mesh has no triangle of the material M_Face");
        return true;
    }

    std::vector<std::array<float, 3>> corners_;
    std::vector<std::array<float, 2>> places_;
    std::optional<HeadPart> part_;
    std::array<std::vector<std::array<std::uint32_t, 3>>, part_count> of_part_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies_;
    std::size_t count_ = 0;
};

// Calls take(name, offsets) for each shape, with offsets of the model's vertices. Empty, or the end
// of a sentence.
template <class Take>
std::string read_shapes(ByteView bytes, const MeshReader& mesh, const char* file, Take&& take) {
    const std::string name_of_file = std::string("its file ") + file;
    ByteReader in(bytes);
    const ByteView magic = in.get_bytes(shapes_magic.size()), expected = as_bytes(shapes_magic);
    if (!std::equal(magic.begin(), magic.end(), expected.begin(), expected.end()))
        return name_of_file + " does not begin with ICTFKL01";
    const auto shapes = in.get<std::uint32_t>(), vertices = in.get<std::uint32_t>();
    (void)in.get<std::uint32_t>();
    if (shapes > max_shapes || vertices != mesh.read_vertices())
        return name_of_file + " is of another mesh";
    for (std::uint32_t i = 0; i < shapes; ++i) {
        const ByteView name = in.get_bytes(in.get<std::uint16_t>());
        const float scale = get_f32(in) * mm_per_cm;
        const ByteView values = in.get_bytes(std::size_t(vertices) * 6);
        if (!in.ok())
            return name_of_file + " ends early";
        if (!std::isfinite(scale) || std::fabs(scale) > most_mm / 32768)
            return name_of_file + " has a shape that is too large";
        std::vector<float> offsets;
        offsets.reserve(mesh.of_mesh.size() * 3);
        for (const std::uint32_t vertex : mesh.of_mesh)
            for (std::size_t k = 0; k < 3; ++k)
                offsets.push_back(scale * float(load_le<std::int16_t>(
                                              values.data() + std::size_t(vertex) * 6 + 2 * k)));
        if (!take(std::string_view(reinterpret_cast<const char*>(name.data()), name.size()),
                  std::move(offsets)))
            return name_of_file + " has a shape whose name is none of ARKit's";
    }
    return in.rest().empty() ? std::string() : name_of_file + " has more bytes than shapes";
}

// "browDown_L" is ARKit's browDownLeft, and "cheekPuff_L" a half of its cheekPuff.
std::optional<Channel> channel_of_ict(std::string_view name) {
    std::string_view side;
    if (name.size() > 2 && name[name.size() - 2] == '_') {
        side = name.back() == 'L' ? "Left" : name.back() == 'R' ? "Right" : "?";
        name.remove_suffix(2);
    }
    const auto sided = channel_of(std::string(name) + std::string(side));
    return sided || side.empty() || side == "?" ? sided : channel_of(name);
}

}  // namespace

IctRead read_ict_head(const IctFiles& files) {
    MeshReader mesh;
    if (!mesh.read(files.mesh))
        return {{}, std::move(mesh.problem)};
    MorphModel& model = mesh.model;
    for (std::size_t i = 0; i < landmark_count; ++i) {
        const std::uint32_t vertex = files.landmarks[i];
        if (vertex >= mesh.first_copy.size() || mesh.first_copy[vertex] == no_vertex)
            return {{}, "one of its landmarks is no vertex of the face"};
        model.landmarks[i] = mesh.first_copy[vertex];
    }
    std::string problem =
        read_shapes(files.expressions, mesh, "of expressions",
                    [&](std::string_view name, std::vector<float> offsets) {
                        const auto channel = channel_of_ict(name);
                        if (channel)
                            model.expressions.push_back({*channel, std::move(offsets)});
                        return channel.has_value();
                    });
    if (problem.empty())
        problem = read_shapes(files.identities, mesh, "of identities",
                              [&](std::string_view, std::vector<float> offsets) {
                                  model.identities.push_back(std::move(offsets));
                                  return true;
                              });
    if (!problem.empty())
        return {{}, std::move(problem)};
    return {std::move(model), {}};
}

}  // namespace theatron::face
