// SPDX-License-Identifier: Apache-2.0
// STL: binary, 80 bytes of any text, a count and 50 bytes for each facet; or words.
#include <algorithm>
#include <cstring>
#include <string_view>

#include "cases/mesh_files.h"
#include "cases/text_words.h"

namespace theatron::cases {
namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50;

void add_corner(NamedMesh& named, const float (&p)[3]) {
    std::vector<medical::Vec3f>& positions = named.mesh.positions;
    positions.push_back({p[0], p[1], p[2]});
    if (positions.size() % 3 == 0) {
        const auto end = std::uint32_t(positions.size());
        named.mesh.triangles.push_back({end - 3, end - 2, end - 1});
    }
}

// The number of facets. Programs that write to a pipe leave 0 or the largest number in its place:
// then all that follows are facets, if they are whole ones.
std::size_t facets_of(ByteView file) {
    const auto said = load_le<std::uint32_t>(file.data() + 80);
    const std::size_t behind = file.size() - head_bytes;
    const bool is_said = said != 0 && said != 0xffffffff;
    return is_said || behind % facet_bytes != 0 ? said : behind / facet_bytes;
}

// True if whole facets follow those that are announced: the file has two numbers of them.
bool has_more_facets(ByteView behind) {
    return behind.size() >= facet_bytes && behind.size() % facet_bytes == 0 &&
           std::any_of(behind.begin(), behind.end(), [](std::byte b) { return b != std::byte(0); });
}

Answer read_binary(ByteView file, const TakeMesh& take) {
    const std::size_t count = facets_of(file);
    if (count > medical::max_mesh_triangles)
        return count <= (file.size() - head_bytes) / facet_bytes ? Answer::too_large
                                                                 : Answer::lacks;
    if (count > (file.size() - head_bytes) / facet_bytes)
        return Answer::lacks;
    if (has_more_facets(file.subspan(head_bytes + facet_bytes * count)))
        return Answer::more;
    NamedMesh named;
    named.mesh.positions.reserve(3 * count);
    named.mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            float p[3];
            std::memcpy(p, file.data() + head_bytes + facet_bytes * i + 12 + 12 * corner, 12);
            add_corner(named, p);
        }
    if (count > 0)
        take(named);
    return count > 0 ? Answer::end : Answer::no_triangles;
}

Answer read_text(ByteView file, const TakeMesh& take) {
    TextWords words(file);
    NamedMesh named;
    std::size_t facet_begin = 0;
    bool any = false;
    const auto hand_over = [&] {
        const bool go_on = named.mesh.triangles.empty() || take(named);
        any = any || !named.mesh.triangles.empty();
        named = {};
        facet_begin = 0;
        return go_on;
    };
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (is_word(word, "solid") || is_word(word, "endsolid")) {
            if (named.mesh.positions.size() % 3 != 0)
                return Answer::lacks;
            if (!hand_over())
                return Answer::end;
            named.name = words.rest_of_line();
        } else if (is_word(word, "endloop")) {
            if (named.mesh.positions.size() != facet_begin + 3)
                return Answer::polygons;
            facet_begin += 3;
        } else if (is_word(word, "vertex")) {
            float p[3];
            for (float& coordinate : p)
                if (!to_number(words.next(), coordinate))
                    return words.at_end() ? Answer::lacks : Answer::unreadable;
            // A fourth number: it is not known which three are meant ("1 234.5 ...").
            float more = 0;
            if (TextWords ahead = words; to_number(ahead.next(), more))
                return Answer::unreadable;
            if (named.mesh.triangles.size() == medical::max_mesh_triangles)
                return Answer::too_large;
            add_corner(named, p);
        }
    }
    if (named.mesh.positions.size() % 3 != 0)
        return Answer::lacks;
    if (!hand_over())
        return Answer::end;
    return any ? Answer::end : Answer::no_triangles;
}

}  // namespace

Answer read_stl(ByteView file, const TakeMesh& take) {
    // Binary files may begin with "solid", too: their size tells them.
    if (file.size() >= head_bytes) {
        const std::uint64_t count = load_le<std::uint32_t>(file.data() + 80);
        if (file.size() == head_bytes + facet_bytes * count)
            return read_binary(file, take);
    }
    const std::size_t looked_at = std::min<std::size_t>(file.size(), 1024);
    const bool is_text = std::none_of(file.begin(), file.begin() + std::ptrdiff_t(looked_at),
                                      [](std::byte b) { return b == std::byte(0); });
    TextWords words(file);
    if (is_text)
        return is_word(words.next(), "solid") ? read_text(file, take) : Answer::no_mesh;
    return file.size() >= head_bytes ? read_binary(file, take) : Answer::no_mesh;
}

}  // namespace theatron::cases
