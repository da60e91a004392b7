// SPDX-License-Identifier: Apache-2.0
// The contents of printed sheets and screens in the room.
#include <string>

#include "synthetic/noise.h"
#include "synthetic/picture.h"

namespace theatron::synthetic {
namespace {

constexpr Rgb ink{20, 24, 34}, blue{20, 60, 150}, red{190, 30, 30};

Canvas checklist() {
    Canvas c({1024, 1448}, {244, 243, 238});
    c.rectangle(0, 0, 1024, 130, {24, 84, 140});
    c.text(48, 38, 54, "SURGICAL CHECKLIST", {250, 250, 250});
    const char* lines[] = {"PATIENT CONFIRMED", "SITE MARKED",         "ANAESTHESIA CHECKED",
                           "ALLERGIES: NONE",   "IMAGES DISPLAYED",    "STERILITY OK",
                           "ANTIBIOTICS 08:42", "SWABS 20  NEEDLES 6", "INSTRUMENTS 38",
                           "SPECIMEN LABELLED", "COUNT COMPLETE"};
    float y = 190;
    int i = 0;
    for (const char* line : lines) {
        for (int e = 0; e < 4; ++e) {
            const float x0 = e == 1 ? 92.0f : 52.0f, x1 = e == 3 ? 52.0f : 92.0f;
            const float ya = y + (e == 2 ? 40.0f : 0.0f), yb = y + (e == 0 ? 0.0f : 40.0f);
            c.line(x0, ya, e == 0 || e == 2 ? 92.0f : x1, e == 0 || e == 2 ? ya : yb, 4, ink);
        }
        if (i++ < 8) {
            c.line(58, y + 18, 70, y + 34, 8, blue);
            c.line(70, y + 34, 100, y - 8, 8, blue);
        }
        c.text(130, y, 40, line, ink);
        c.line(48, y + 66, 976, y + 66, 2, {170, 170, 170});
        y += 94;
    }
    c.text(48, 1250, 30, "SIGNED", ink);
    float x = 240;
    for (int k = 0; k < 40; ++k) {
        const float nx = x + 11;
        c.line(x, 1270 + 30 * std::sin(float(k) * 1.1f), nx,
               1270 + 30 * std::sin(float(k + 1) * 1.1f + 0.3f * float(k % 3)), 4, blue);
        x = nx;
    }
    for (int k = 0; k < 60; ++k)  // a bar code
        if (hash(std::uint32_t(k)) % 3 != 0)
            c.rectangle(float(540 + 7 * k), 1340,
                        float(540 + 7 * k + 1 + int(hash(std::uint32_t(k + 99)) % 5)), 1420, ink);
    return c;
}

void trace(Canvas& c, float x0, float x1, float y, float height, float beats, int kind, Rgb color) {
    float px = x0, py = y;
    for (int i = 0; i <= int((x1 - x0) / 2); ++i) {
        const float x = x0 + 2 * float(i);
        const float phase = std::fmod((x - x0) / (x1 - x0) * beats, 1.0f);
        const auto bump = [&](float at, float width, float h) {
            return h * std::exp(-(phase - at) * (phase - at) / (width * width));
        };
        float v = 0;
        if (kind == 0)  // electrocardiogram
            v = bump(0.2f, 0.03f, 0.12f) - bump(0.31f, 0.012f, 0.15f) + bump(0.34f, 0.014f, 1) -
                bump(0.375f, 0.014f, 0.25f) + bump(0.58f, 0.05f, 0.22f);
        else if (kind == 1)  // pulse wave
            v = bump(0.3f, 0.1f, 0.9f) + bump(0.55f, 0.09f, 0.4f);
        else  // expired carbon dioxide
            v = 0.8f * smoothstep(0.2f, 0.3f, phase) * (1 - smoothstep(0.68f, 0.74f, phase)) +
                0.1f * phase;
        const float ny = y - v * height;
        c.line(px, py, x, ny, 4, color);
        px = x;
        py = ny;
    }
}

Canvas vitals() {
    Canvas c({1024, 640}, {6, 9, 14});
    const Rgb green{60, 240, 90}, cyan{70, 215, 240}, yellow{245, 225, 80}, white{235, 235, 235};
    c.rectangle(0, 0, 1024, 46, {28, 40, 60});
    c.text(20, 10, 26, "OR 2   ADULT   14:07:32", white);
    trace(c, 20, 700, 190, 110, 7, 0, green);
    trace(c, 20, 700, 370, 110, 7, 1, cyan);
    trace(c, 20, 700, 560, 110, 3, 2, yellow);
    c.text(740, 64, 26, "ECG", green);
    c.text(770, 100, 100, "72", green);
    c.text(740, 244, 26, "SPO2 %", cyan);
    c.text(770, 280, 100, "98", cyan);
    c.text(740, 424, 26, "CO2", yellow);
    c.text(770, 460, 70, "5.1", yellow);
    c.text(740, 566, 46, "121/78", {250, 110, 110});
    return c;
}

// An axial slice through the upper abdomen, as a scanner shows it.
Canvas slice() {
    Canvas c({768, 640}, {3, 3, 4});
    const auto grey = [](int v) { return Rgb{std::uint8_t(v), std::uint8_t(v), std::uint8_t(v)}; };
    c.ellipse(384, 325, 318, 235, 0, grey(70));
    c.ellipse(384, 325, 296, 213, 0, grey(120));
    c.ellipse(384, 322, 276, 194, 0, grey(92));
    for (int i = 0; i < 18; ++i) {  // ribs
        const float a = 2 * pi * (float(i) + 0.3f) / 18;
        if (std::sin(a) < -0.97f)
            continue;
        c.ellipse(384 + 284 * std::cos(a), 324 + 202 * std::sin(a), 17, 7, a + pi / 2, grey(235));
    }
    c.ellipse(270, 285, 148, 130, -0.3f, grey(150));  // liver
    c.ellipse(385, 235, 84, 50, 0.3f, grey(148));
    c.ellipse(215, 250, 13, 9, 0, grey(120));
    c.ellipse(290, 310, 22, 7, 0.7f, grey(182));
    c.ellipse(260, 270, 30, 6, -0.4f, grey(180));
    c.ellipse(318, 268, 27, 22, 0, grey(58));      // a cyst
    c.ellipse(498, 262, 76, 55, 0.5f, grey(112));  // stomach
    c.ellipse(494, 240, 52, 24, 0.4f, grey(6));
    c.ellipse(592, 345, 40, 82, 0.35f, grey(156));  // spleen
    c.ellipse(282, 432, 48, 38, 0.4f, grey(165));   // kidneys
    c.ellipse(506, 436, 48, 38, -0.4f, grey(165));
    c.ellipse(290, 436, 17, 12, 0.4f, grey(110));
    c.ellipse(498, 440, 17, 12, -0.4f, grey(110));
    c.ellipse(384, 450, 46, 38, 0, grey(222));  // vertebra
    c.ellipse(384, 452, 34, 26, 0, grey(178));
    c.ellipse(384, 496, 20, 15, 0, grey(100));
    c.line(384, 505, 384, 540, 14, grey(225));
    c.line(345, 490, 320, 510, 12, grey(220));
    c.line(423, 490, 448, 510, 12, grey(220));
    c.ellipse(412, 386, 24, 24, 0, grey(205));  // aorta
    c.ellipse(348, 388, 25, 19, 0.2f, grey(172));
    c.text(20, 20, 24, "CT ABDOMEN  AXIAL", {220, 200, 90});
    c.text(20, 590, 24, "SLICE 84/212", {220, 200, 90});
    c.text(560, 590, 24, "W 400 L 40", {220, 200, 90});
    c.line(262, 262, 250, 200, 3, {240, 90, 60});
    c.text(160, 170, 22, "42 MM", {240, 90, 60});
    ColorImage& image = c.image();
    for (int y = 0; y < image.size.height; ++y)
        for (int x = 0; x < image.size.width; ++x) {
            Rgb& p = image.view().row(y)[x];
            if (p.r > 30 && p.r == p.g) {
                const float n = 14 * noise({float(x) * 0.35f, float(y) * 0.35f, 1}) +
                                9 * noise({float(x) * 0.05f, float(y) * 0.05f, 7});
                const auto v = std::uint8_t(std::clamp(float(p.r) + n, 0.0f, 255.0f));
                p = {v, v, v};
            }
        }
    return c;
}

Canvas anaesthesia() {
    Canvas c({512, 384}, {10, 22, 40});
    trace(c, 20, 330, 110, 70, 3, 2, {250, 210, 60});
    trace(c, 20, 330, 230, 70, 3, 1, {90, 220, 250});
    trace(c, 20, 330, 350, 70, 3, 1, {120, 250, 130});
    c.text(360, 40, 50, "480", {250, 210, 60});
    c.text(360, 150, 50, "12", {90, 220, 250});
    c.text(360, 260, 50, "2.1%", {120, 250, 130});
    return c;
}

Canvas label() {
    Canvas c({512, 256}, {250, 247, 200});
    c.rectangle(0, 0, 512, 60, {200, 40, 40});
    c.text(24, 14, 32, "STERILE", {255, 255, 255});
    c.text(24, 84, 40, "SET 4 LIVER", ink);
    c.text(24, 144, 30, "LOT 20716-B", ink);
    for (int k = 0; k < 50; ++k)
        if (hash(std::uint32_t(k + 7)) % 2)
            c.rectangle(float(24 + 9 * k), 196, float(24 + 9 * k + 5), 240, ink);
    return c;
}

Canvas wall_clock() {
    Canvas c({512, 512}, {246, 246, 244});
    c.ellipse(256, 256, 250, 250, 0, {40, 40, 44});
    c.ellipse(256, 256, 232, 232, 0, {250, 250, 248});
    for (int i = 0; i < 60; ++i) {
        const float a = 2 * pi * float(i) / 60, r = i % 5 == 0 ? 185.0f : 208.0f;
        c.line(256 + r * std::cos(a), 256 + r * std::sin(a), 256 + 220 * std::cos(a),
               256 + 220 * std::sin(a), i % 5 == 0 ? 9.0f : 3.0f, ink);
    }
    c.line(256, 256, 256 + 108, 256 - 58, 15, ink);
    c.line(256, 256, 256 + 120, 256 + 145, 10, ink);
    c.line(256, 290, 256, 90, 4, red);
    return c;
}

Canvas note() {
    Canvas c({800, 560}, {250, 250, 250});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x)
            if ((x + y) % 2 == 0)
                c.rectangle(float(40 + 60 * x), float(40 + 60 * y), float(100 + 60 * x),
                            float(100 + 60 * y), {12, 12, 12});
    c.text(490, 50, 64, "BED 2", blue);
    float h = 48, y = 150;
    for (int i = 0; i < 6; ++i, y += h * 1.2f, h *= 0.78f)
        c.text(490, y, h, "EHKVZ 35", ink);
    c.text(40, 380, 50, "THEATRON  TEST CHART 01", red);
    c.text(40, 456, 32, "0123456789 ABCDEFGHIJKLMNOPQRS", ink);
    c.text(40, 512, 20, "READ THE SMALLEST LINE THAT IS STILL SHARP", ink);
    return c;
}

}  // namespace

std::vector<Picture> make_pictures() {
    std::vector<Picture> pictures;
    for (const Canvas& c :
         {checklist(), vitals(), slice(), anaesthesia(), label(), wall_clock(), note()})
        pictures.emplace_back(c.image());
    return pictures;
}

}  // namespace theatron::synthetic
