// SPDX-License-Identifier: Apache-2.0
// PLY: a head that lists elements and their properties, then their values as text or in binary.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "cases/mesh_files.h"
#include "cases/polygon.h"
#include "cases/text_words.h"

namespace theatron::cases {
namespace {

enum class Form : std::uint8_t { text, little, big };

struct Property {
    std::string name;
    char type = 0, count_type = 0;  // a letter for each type; a count: it is a list
};
struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};
struct Head {
    Form form = Form::text;
    std::vector<Element> elements;
};

constexpr std::size_t max_elements = 64, max_properties = 256, max_list = 1'000'000'000;

// 0: not known.
char type_of(std::string_view name) {
    constexpr std::pair<std::string_view, char> names[] = {
        {"char", 'b'},  {"int8", 'b'},    {"uchar", 'B'},  {"uint8", 'B'},
        {"short", 'h'}, {"int16", 'h'},   {"ushort", 'H'}, {"uint16", 'H'},
        {"int", 'i'},   {"int32", 'i'},   {"uint", 'I'},   {"uint32", 'I'},
        {"float", 'f'}, {"float32", 'f'}, {"double", 'd'}, {"float64", 'd'}};
    for (const auto& [known, letter] : names)
        if (is_word(name, known))
            return letter;
    return 0;
}

std::size_t size_of(char type) {
    return type == 'b' || type == 'B' ? 1 : type == 'h' || type == 'H' ? 2 : type == 'd' ? 8 : 4;
}

// Moves `words` behind the head.
std::optional<Head> read_head(TextWords& words) {
    if (!is_word(words.next(), "ply"))
        return std::nullopt;
    Head head;
    bool has_form = false;
    while (!words.at_end()) {
        words.skip_line();
        const std::string_view word = words.next();
        if (is_word(word, "format")) {
            const std::string_view form = words.next();
            has_form = true;
            if (is_word(form, "binary_little_endian"))
                head.form = Form::little;
            else if (is_word(form, "binary_big_endian"))
                head.form = Form::big;
            else if (!is_word(form, "ascii"))
                return std::nullopt;
        } else if (is_word(word, "element")) {
            Element element;
            element.name = std::string(words.next());
            if (!to_number(words.next(), element.count) || head.elements.size() == max_elements)
                return std::nullopt;
            head.elements.push_back(std::move(element));
        } else if (is_word(word, "property")) {
            Property property;
            std::string_view type = words.next();
            if (is_word(type, "list")) {
                property.count_type = type_of(words.next());
                type = words.next();
                if (property.count_type == 0)
                    return std::nullopt;
            }
            property.type = type_of(type);
            property.name = std::string(words.next());
            if (head.elements.empty() || property.type == 0 ||
                head.elements.back().properties.size() == max_properties)
                return std::nullopt;
            head.elements.back().properties.push_back(std::move(property));
        } else if (is_word(word, "end_header")) {
            words.skip_line();
            return has_form ? std::optional(std::move(head)) : std::nullopt;
        }
    }
    return std::nullopt;
}

// The values behind the head, one after another.
class Values {
public:
    Values(ByteView content, Form form) : content_(content), words_(content), form_(form) {}

    bool next(char type, double& out) {
        if (form_ == Form::text)
            return to_number(words_.next(), out);
        const std::size_t size = size_of(type);
        if (content_.size() - at_ < size)
            return false;
        std::byte bytes[8];
        for (std::size_t i = 0; i < size; ++i)
            bytes[i] = content_[at_ + (form_ == Form::big ? size - 1 - i : i)];
        at_ += size;
        out = value_of(type, bytes);
        return true;
    }
    std::size_t bytes_left() const {
        return content_.size() - (form_ == Form::text ? words_.place() : at_);
    }

private:
    template <class T>
    static double as(const std::byte* bytes) {
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return double(value);
    }
    static double value_of(char type, const std::byte* bytes) {
        switch (type) {
            case 'b':
                return as<std::int8_t>(bytes);
            case 'B':
                return as<std::uint8_t>(bytes);
            case 'h':
                return as<std::int16_t>(bytes);
            case 'H':
                return as<std::uint16_t>(bytes);
            case 'i':
                return as<std::int32_t>(bytes);
            case 'I':
                return as<std::uint32_t>(bytes);
            case 'f':
                return as<float>(bytes);
            default:
                return as<double>(bytes);
        }
    }

    ByteView content_;
    TextWords words_;
    Form form_;
    std::size_t at_ = 0;
};

bool are_indices(const Property& property) {
    return property.count_type != 0 &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

// 0 to 2; nothing for other properties.
std::optional<std::size_t> axis_of(const Property& property) {
    constexpr std::string_view names[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3 && property.count_type == 0; ++axis)
        if (is_word(property.name, names[axis]))
            return axis;
    return std::nullopt;
}

bool has_places(const Element& vertex) {
    bool has[3] = {};
    for (const Property& property : vertex.properties)
        if (const auto axis = axis_of(property))
            has[*axis] = true;
    return has[0] && has[1] && has[2];
}

class Reader {
public:
    Reader(ByteView content, Form form) : values_(content, form) {}

    Answer read(const Element& element) {
        // A value takes a byte at least.
        if (element.count > values_.bytes_left() && !element.properties.empty())
            return Answer::lacks;
        if (element.properties.empty())
            return Answer::content;
        const bool is_vertex = element.name == "vertex";
        if (is_vertex && !has_places(element))
            return Answer::no_places;
        if (is_vertex && element.count > max_loose_vertices)
            return Answer::too_large;
        const bool has_indices =
            std::any_of(element.properties.begin(), element.properties.end(), are_indices);
        const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
        if (has_indices && !is_face && !is_strip)
            return Answer::no_mesh;
        for (std::size_t i = 0; i < element.count; ++i)
            if (const Answer read = read_one(element, is_vertex, is_strip); read != Answer::content)
                return read;
        return Answer::content;
    }

    // Polygons and strips wait for the vertices, which may follow them.
    Answer finish(NamedMesh& named) {
        named.mesh.positions = std::move(positions_);
        std::vector<medical::Triangle>& triangles = named.mesh.triangles;
        std::size_t begin = 0;
        for (const Run& run : runs_) {
            const std::span<const std::uint32_t> corners(indices_.data() + begin, run.count);
            begin += run.count;
            if (run.is_strip)
                add_strip(corners, triangles);
            for (const std::uint32_t corner : corners)
                if (corner >= named.mesh.positions.size() && !(run.is_strip && corner == restart))
                    return Answer::unreadable;
            if (!run.is_strip && corners.size() > max_polygon_corners)
                return Answer::too_large;
            if (!run.is_strip)
                add_polygon(corners, named.mesh.positions, triangles);
            if (triangles.size() > medical::max_mesh_triangles)
                return Answer::too_large;
        }
        return triangles.empty() ? Answer::no_triangles : Answer::content;
    }

private:
    struct Run {
        std::size_t count;
        bool is_strip;
    };
    static constexpr std::uint32_t restart = 0xffffffff;  // -1: a strip ends

    Answer read_one(const Element& element, bool is_vertex, bool is_strip) {
        double p[3] = {0, 0, 0};
        for (const Property& property : element.properties) {
            double value = 0;
            if (property.count_type == 0) {
                if (!values_.next(property.type, value))
                    return Answer::lacks;
                if (const auto axis = is_vertex ? axis_of(property) : std::nullopt)
                    p[*axis] = value;
                continue;
            }
            double count = 0;
            if (!values_.next(property.count_type, count))
                return Answer::lacks;
            if (!(count >= 0 && count <= double(max_list)) || count != std::floor(count))
                return Answer::unreadable;
            if (count > double(values_.bytes_left()))
                return Answer::lacks;
            const bool kept = are_indices(property);
            for (double i = 0; i < count; ++i) {
                if (!values_.next(property.type, value))
                    return Answer::lacks;
                if (!kept)
                    continue;
                const bool ends = is_strip && value == -1;
                if (!ends &&
                    (!(value >= 0 && value < double(restart)) || value != std::floor(value)))
                    return Answer::unreadable;
                indices_.push_back(ends ? restart : std::uint32_t(value));
            }
            if (kept)
                runs_.push_back({std::size_t(count), is_strip});
        }
        if (is_vertex)
            positions_.push_back({float(p[0]), float(p[1]), float(p[2])});
        return Answer::content;
    }

    static void add_strip(std::span<const std::uint32_t> strip,
                          std::vector<medical::Triangle>& triangles) {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < strip.size(); ++i) {
            if (strip[i] == restart) {
                begin = i + 1;
                continue;
            }
            if (i < begin + 2)
                continue;
            const std::uint32_t a = strip[i - 2], b = strip[i - 1], c = strip[i];
            // Repeated corners only lead to the next part of the strip.
            if (a == b || b == c || a == c)
                continue;
            const bool is_odd = (i - begin) % 2 == 1;
            triangles.push_back({is_odd ? b : a, is_odd ? a : b, c});
        }
    }

    Values values_;
    std::vector<medical::Vec3f> positions_;
    std::vector<std::uint32_t> indices_;
    std::vector<Run> runs_;
};

}  // namespace

Answer read_ply(ByteView file, const TakeMesh& take) {
    TextWords words(file);
    const std::optional<Head> head = read_head(words);
    if (!head)
        return Answer::no_mesh;
    Reader reader(file.subspan(words.place()), head->form);
    for (const Element& element : head->elements)
        if (const Answer read = reader.read(element); read != Answer::content)
            return read;
    NamedMesh named;
    if (const Answer finished = reader.finish(named); finished != Answer::content)
        return finished;
    take(named);
    return Answer::end;
}

}  // namespace theatron::cases
