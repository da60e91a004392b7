// SPDX-License-Identifier: Apache-2.0
#include "cases/label_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>

#include "cases/label_surface.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Bytes gzip(ByteView content) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
    Bytes out(deflateBound(&stream, content.size()) + 64);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(content.data()));
    stream.avail_in = uInt(content.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = uInt(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

Bytes operator+(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Bytes bytes_of(std::string_view text) {
    const ByteView view = as_bytes(text);
    return {view.begin(), view.end()};
}

const std::string nrrd_head =
    "NRRD0004\n# a comment\ntype: unsigned char\ndimension: 3\n"
    "space: left-posterior-superior\nsizes: 3 2 2\n"
    "space directions: (0.5,0,0) (0,0.5,0) (0,0,2)\nspace origin: (-10,20,-30)\n"
    "endian: little\n";

Bytes nrrd(const std::string& more, const Bytes& content, std::string head = nrrd_head) {
    return bytes_of(head + more + "\n") + content;
}

const Bytes twelve_labels = [] {
    Bytes bytes;
    for (const int label : {0, 1, 1, 0, 2, 2, 0, 0, 0, 7, 0, 255})
        bytes.push_back(std::byte(label));
    return bytes;
}();

TEST(Nrrd, RawAndPackedLabelsAreRead) {
    const Bytes raw = nrrd("encoding: raw\n", twelve_labels);
    const Bytes packed =
        nrrd("encoding: gzip\nSegment0_Name:=Liver\nSegment0_LabelValue:=7\n", gzip(twelve_labels));
    for (const Bytes& file : {raw, packed}) {
        const ParsedLabels parsed = parse_nrrd(file);
        ASSERT_EQ(parsed.problem, "");
        EXPECT_EQ(parsed.value.grid.columns, 3);
        EXPECT_EQ(parsed.value.grid.slices, 2);
        EXPECT_EQ(parsed.value.grid.origin_mm, (Vec3{-10, 20, -30}));
        EXPECT_EQ(parsed.value.grid.slice_step_mm, (Vec3{0, 0, 2}));
        EXPECT_THAT(parsed.value.labels, ElementsAre(0, 1, 1, 0, 2, 2, 0, 0, 0, 7, 0, 255));
    }
    EXPECT_THAT(parse_nrrd(packed).value.names, ElementsAre(LabelName{7, "Liver"}));
}

TEST(Nrrd, OtherAxesAndTypesBecomeOurs) {
    std::string head = nrrd_head;
    head.replace(head.find("left-posterior"), 14, "right-anterior");
    head.replace(head.find("unsigned char"), 13, "float");
    head.replace(head.find("little"), 6, "big");
    Bytes content;
    for (int i = 0; i < 12; ++i) {
        const float value = float(i * 100);
        std::byte bytes[4];
        std::memcpy(bytes, &value, 4);
        content.insert(content.end(), {bytes[3], bytes[2], bytes[1], bytes[0]});
    }
    const ParsedLabels parsed = parse_nrrd(nrrd("encoding: raw\n", content, head));
    ASSERT_EQ(parsed.problem, "");
    EXPECT_EQ(parsed.value.grid.origin_mm, (Vec3{10, -20, -30}));
    EXPECT_EQ(parsed.value.grid.column_step_mm.x, -0.5);
    EXPECT_EQ(parsed.value.labels[11], 1100);
}

TEST(Nrrd, EachProblemIsNamed) {
    const auto problem = [](const std::string& from, const std::string& to,
                            const std::string& more = "encoding: raw\n") {
        std::string head = nrrd_head;
        if (!from.empty())
            head.replace(head.find(from), from.size(), to);
        return parse_nrrd(nrrd(more, twelve_labels, head)).problem;
    };
    EXPECT_THAT(parse_nrrd(bytes_of("PNG")).problem, HasSubstr("no NRRD"));
    EXPECT_THAT(parse_nrrd(bytes_of(nrrd_head)).problem, HasSubstr("cut off"));
    EXPECT_THAT(problem("dimension: 3", "dimension: 5"), HasSubstr("three dimensions"));
    EXPECT_THAT(problem("dimension: 3", "dimension: 4"), HasSubstr("'sizes' with '3 2 2'"));
    EXPECT_THAT(problem("sizes: 3 2 2", "sizes: 3 2 3"), HasSubstr("less than its header"));
    EXPECT_THAT(problem("sizes: 3 2 2", "sizes: 3 2 -2"), HasSubstr("side of no samples"));
    EXPECT_THAT(problem("sizes: 3 2 2", "sizes: 4000 4000 4000"), HasSubstr("more samples"));
    EXPECT_THAT(problem("space: left", "space: top"), HasSubstr("where in the patient"));
    EXPECT_THAT(problem("(0,0.5,0)", "(0.5,0,0)"), HasSubstr("impossible"));
    EXPECT_THAT(problem("unsigned char", "block"), HasSubstr("type"));
    EXPECT_THAT(problem("", "", "encoding: hex\n"), HasSubstr("gzip"));
    EXPECT_THAT(problem("", "", "encoding: gzip\n"), HasSubstr("damaged"));
    EXPECT_THAT(problem("unsigned char", "signed char"), HasSubstr("no labels"));
}

TEST(Nrrd, ABombIsBounded) {
    // 256 Mi samples of zeros in 255 KiB: more than announced stays packed, and a header that
    // announces more than the file can hold is refused before memory is taken.
    std::string head = nrrd_head;
    head.replace(head.find("sizes: 3 2 2"), 12, "sizes: 512 512 1024");
    const Bytes small = gzip(Bytes(1 << 20));
    EXPECT_THAT(parse_nrrd(nrrd("encoding: gzip\n", small, head)).problem,
                HasSubstr("less than its header announces"));
    const ParsedLabels first = parse_nrrd(nrrd("encoding: gzip\n", gzip(Bytes(64 << 20))));
    EXPECT_EQ(first.problem, "");
    EXPECT_EQ(first.value.labels.size(), 12u);
}

// A header of the fields that matter, little-endian.
Bytes nifti(int type, const Bytes& samples, bool with_matrix = true) {
    Bytes file(352);
    const auto i16 = [&](std::size_t at, int value) { store_le(&file[at], std::int16_t(value)); };
    const auto f32 = [&](std::size_t at, float value) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, 4);
        store_le(&file[at], bits);
    };
    store_le(&file[0], std::int32_t(348));
    for (const auto& [i, n] : {std::pair{0, 3}, {1, 3}, {2, 2}, {3, 2}, {4, 1}})
        i16(40 + 2 * std::size_t(i), n);
    i16(70, type);
    for (const auto& [i, mm] : {std::pair{0, -1.f}, {1, 0.5f}, {2, 0.5f}, {3, 2.f}})
        f32(76 + 4 * std::size_t(i), mm);
    f32(108, 352);
    f32(112, 1);
    if (with_matrix) {
        i16(254, 1);
        f32(280, -0.5f), f32(292, 10);
        f32(300, -0.5f), f32(308, -20);
        f32(320, 2), f32(324, -30);
    } else {
        // Half a turn about z: x and y the other way round; and the slices turned by pixdim[0].
        i16(252, 1);
        f32(264, 1);
        f32(268, 10), f32(272, -20), f32(276, -30);
    }
    std::memcpy(&file[344], "n+1", 4);
    return file + samples;
}

TEST(Nifti, RawAndPackedLabelsAreRead) {
    const Bytes raw = nifti(2, twelve_labels);
    for (const Bytes& file : {raw, gzip(raw)}) {
        const ParsedLabels parsed = parse_nifti(file);
        ASSERT_EQ(parsed.problem, "");
        EXPECT_EQ(parsed.value.grid.origin_mm, (Vec3{-10, 20, -30}));
        EXPECT_EQ(parsed.value.grid.column_step_mm, (Vec3{0.5, 0, 0}));
        EXPECT_EQ(parsed.value.grid.row_step_mm, (Vec3{0, 0.5, 0}));
        EXPECT_EQ(parsed.value.grid.slice_step_mm, (Vec3{0, 0, 2}));
        EXPECT_THAT(parsed.value.labels, ElementsAre(0, 1, 1, 0, 2, 2, 0, 0, 0, 7, 0, 255));
    }
}

TEST(Nifti, AQuaternionGivesThePlaceWhereThereIsNoMatrix) {
    const ParsedLabels parsed = parse_nifti(nifti(2, twelve_labels, false));
    ASSERT_EQ(parsed.problem, "");
    EXPECT_NEAR(length(parsed.value.grid.column_step_mm - Vec3{0.5, 0, 0}), 0, 1e-6);
    EXPECT_NEAR(length(parsed.value.grid.row_step_mm - Vec3{0, 0.5, 0}), 0, 1e-6);
    EXPECT_NEAR(length(parsed.value.grid.slice_step_mm - Vec3{0, 0, -2}), 0, 1e-6);
}

TEST(Nrrd, LayersAreReadOneByOne) {
    std::string head = nrrd_head;
    head.replace(head.find("dimension: 3"), 12, "dimension: 4");
    head.replace(head.find("sizes: 3 2 2"), 12, "sizes: 2 3 2 1");
    head.replace(head.find("directions: "), 12, "directions: none ");
    const std::string keys =
        "encoding: raw\nSegment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
        "Segment1_Name:=tumour\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n";
    const Bytes file = nrrd(keys, twelve_labels, head);
    const ParsedLabels first = parse_nrrd(file, 0), second = parse_nrrd(file, 1);
    ASSERT_EQ(first.problem, "");
    EXPECT_EQ(first.layers, 2u);
    EXPECT_THAT(first.value.labels, ElementsAre(0, 1, 2, 0, 0, 0));
    EXPECT_THAT(second.value.labels, ElementsAre(1, 0, 2, 0, 7, 255));
    EXPECT_THAT(second.value.names, ElementsAre(LabelName{1, "tumour"}));
}

TEST(Nrrd, AHeaderNamesTheFileOfItsSamples) {
    for (const char* end : {"\n\n", "\n", ""}) {
        const Bytes header = bytes_of(nrrd_head + "encoding: raw\nData File: x.raw" + end);
        EXPECT_EQ(detached_data_of(header), "x.raw");
        const ParsedLabels parsed = parse_nrrd(header, 0, twelve_labels);
        ASSERT_EQ(parsed.problem, "");
        EXPECT_EQ(parsed.value.labels[11], 255);
    }
    EXPECT_EQ(detached_data_of(nrrd("encoding: raw\n", twelve_labels)), "");
}

TEST(Nrrd, UnitsBecomeMillimetresOrAreNamed) {
    const auto read = [](const std::string& units) {
        return parse_nrrd(nrrd("encoding: raw\nSpace Units: " + units + "\n", twelve_labels));
    };
    EXPECT_EQ(read("\"cm\" \"cm\" \"cm\"").value.grid.origin_mm, (Vec3{-100, 200, -300}));
    EXPECT_EQ(read("\"m\" \"m\" \"m\"").value.grid.slice_step_mm, (Vec3{0, 0, 2000}));
    EXPECT_EQ(read("\"inch\" \"inch\" \"inch\"").value.grid.slice_step_mm, (Vec3{0, 0, 50.8}));
    const ParsedLabels other = read("\"pixel\" \"pixel\" \"pixel\"");
    EXPECT_THAT(other.problem, HasSubstr("pixel"));
    EXPECT_TRUE(other.is_other_content);
}

TEST(Nifti, SamplesNearALabelAreThatLabel) {
    const auto read = [](std::initializer_list<float> values) {
        Bytes content;
        for (const float value : values) {
            content.resize(content.size() + 4);
            std::memcpy(content.data() + content.size() - 4, &value, 4);
        }
        content.resize(48);
        return parse_nifti(nifti(16, content));
    };
    const ParsedLabels parsed = read({0.9999999f, 2.0004f, NAN, -0.0f});
    ASSERT_EQ(parsed.problem, "");
    EXPECT_EQ(parsed.value.labels[0], 1);
    EXPECT_EQ(parsed.value.labels[1], 2);
    EXPECT_EQ(parsed.value.labels[2], 0);
    EXPECT_TRUE(read({0.5f}).is_other_content);
    EXPECT_TRUE(read({-3}).is_other_content);
}

TEST(Nifti, SeveralPackedPartsAreOneFile) {
    const Bytes whole = nifti(2, twelve_labels);
    const auto part = [&](std::size_t begin, std::size_t size) {
        return gzip(ByteView(whole).subspan(begin, size));
    };
    Bytes file = part(0, 100) + part(100, 253) + part(353, whole.size() - 353);
    file.resize(file.size() + 64);
    const ParsedLabels parsed = parse_nifti(file);
    ASSERT_EQ(parsed.problem, "");
    EXPECT_THAT(parsed.value.labels, ElementsAre(0, 1, 1, 0, 2, 2, 0, 0, 0, 7, 0, 255));
}

TEST(LabelMap, AnImageIsToldFromAnAtlas) {
    LabelMap map;
    map.grid = {32, 32, 32, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    map.labels.resize(map.grid.size());
    for (std::size_t i = 0; i < map.labels.size(); ++i)
        map.labels[i] = std::uint16_t(1 + i * 7919 % 199);
    EXPECT_TRUE(looks_like_an_image(map));
    for (int z = 0; z < 32; ++z)
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                map.labels[map.grid.index(x, y, z)] =
                    std::uint16_t(1 + x / 4 + 8 * (y / 4) + 64 * (z / 8));
    EXPECT_FALSE(looks_like_an_image(map)) << "256 parcels";
}

TEST(Nifti, EachProblemIsNamed) {
    const auto changed = [](auto change) {
        Bytes file = nifti(2, twelve_labels);
        change(file);
        return parse_nifti(file).problem;
    };
    EXPECT_THAT(parse_nifti({}).problem, HasSubstr("no NIfTI"));
    EXPECT_THAT(changed([](Bytes& f) { f.resize(300); }), HasSubstr("cut off"));
    EXPECT_THAT(changed([](Bytes& f) { f.pop_back(); }), HasSubstr("less than its header"));
    EXPECT_THAT(changed([](Bytes& f) { f[344] = std::byte('x'); }), HasSubstr("version 1 or 2"));
    EXPECT_THAT(changed([](Bytes& f) { f[70] = std::byte(3); }), HasSubstr("type"));
    EXPECT_THAT(changed([](Bytes& f) { f[41] = std::byte(0x7f); }), HasSubstr("than seven"));
    EXPECT_THAT(changed([](Bytes& f) { f[48] = std::byte(5), f[40] = std::byte(4); }),
                HasSubstr("three dimensions"));
    EXPECT_THAT(changed([](Bytes& f) { f[254] = std::byte(0); }),
                HasSubstr("where in the patient"));
    EXPECT_THAT(changed([](Bytes& f) { f[114] = std::byte(0x80), f[115] = std::byte(0x3e); }),
                HasSubstr("no labels"))
        << "a quarter of a label";
    EXPECT_THAT(changed([](Bytes& f) { store_le(&f[108], 0xbf800000u); }), HasSubstr("place"));
    Bytes packed = gzip(nifti(2, twelve_labels));
    packed.resize(packed.size() - 12);
    EXPECT_THAT(parse_nifti(packed).problem, HasSubstr("cut off"));
}

// A ball, a rod as thin as one sample, and two samples that meet at a corner.
LabelMap shapes() {
    LabelMap map;
    map.grid = {60, 60, 30, {0, 0, 0}, {0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 2}};
    map.labels.resize(map.grid.size());
    for (int k = 0; k < 30; ++k)
        for (int j = 0; j < 60; ++j)
            for (int i = 0; i < 60; ++i) {
                std::uint16_t& label = map.labels[map.grid.index(i, j, k)];
                if (length(map.grid.point_at(i, j, k) - Vec3{21, 21, 32}) < 15)
                    label = 1;
                if (k == 1 && j == 1)
                    label = 2;
            }
    map.labels[map.grid.index(50, 50, 2)] = map.labels[map.grid.index(51, 51, 3)] = 3;
    return map;
}

TEST(LabelSurface, IsClosedManifoldSmoothAndAsLargeAsItsSamples) {
    const LabelMap map = shapes();
    for (const LabelCount& label : labels_in(map)) {
        SurfaceBudget budget;
        const medical::Mesh mesh = surface_of_label(map, label, 4000, budget);
        const medical::MeshShape shape = medical::shape_of(mesh);
        EXPECT_TRUE(shape.manifold) << label.value;
        EXPECT_LE(mesh.triangles.size(), 4000u);
        const double volume = double(label.samples) * sample_volume_mm3(map.grid);
        EXPECT_NEAR(shape.volume_mm3, volume, 0.02 * volume) << label.value;
        EXPECT_TRUE(medical::decode_mesh(medical::encode_mesh(mesh)));
    }
    SurfaceBudget budget;
    const medical::Mesh ball = surface_of_label(map, labels_in(map).front(), 4000, budget);
    for (const medical::Vec3f p : ball.positions)
        EXPECT_NEAR(length(medical::to_double(p) - Vec3{21, 21, 32}), 15, 1.1);
}

// A small file may hold a surface that is everywhere, or many labels that are.
TEST(LabelSurface, AllOfAnImportTakeNoMoreThanTheirBudget) {
    LabelMap map;
    map.grid.columns = map.grid.rows = map.grid.slices = 12;
    map.grid.column_step_mm = {1, 0, 0};
    map.grid.row_step_mm = {0, 1, 0};
    map.grid.slice_step_mm = {0, 0, 1};
    for (int i = 0; i < 12 * 12 * 12; ++i)
        map.labels.push_back(std::uint16_t(1 + (i + i / 12 + i / 144) % 2));
    const std::vector<LabelCount> labels = labels_in(map);
    ASSERT_EQ(labels.size(), 2u);
    EXPECT_EQ(labels[0].samples, 864u);
    SurfaceBudget budget;
    const SurfaceBudget whole = budget;
    EXPECT_FALSE(surface_of_label(map, labels[0], 4000, budget).triangles.empty());
    const std::size_t taken = whole.triangles - budget.triangles;
    EXPECT_GT(taken, 10 * labels[0].samples);
    EXPECT_EQ(whole.samples - budget.samples, 14u * 14 * 14);
    budget.triangles = taken - 1;
    EXPECT_TRUE(surface_of_label(map, labels[0], 4000, budget).triangles.empty());
    EXPECT_EQ(budget.triangles, taken - 1);
    budget = {14 * 14 * 14 - 1, taken};
    EXPECT_TRUE(surface_of_label(map, labels[1], 4000, budget).triangles.empty());
}

}  // namespace
}  // namespace theatron::cases
