// SPDX-License-Identifier: Apache-2.0
// Any sequence of readings, as a film could give them: a latency with finite figures, or a
// sentence.
#include <cmath>
#include <cstdlib>

#include "base/bytes.h"
#include "photon/film_strips.h"
#include "photon/latency.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::photon;
    ByteReader in(std::as_bytes(std::span(data, size)));
    FilmStrips strips;
    double film_ms = 0;
    while (in.ok() && !in.rest().empty()) {
        film_ms += in.get<std::uint8_t>() / 8.0;
        const unsigned count = in.get<std::uint8_t>() % 4;
        std::vector<StripReading> readings;
        for (unsigned i = 0; i < count; ++i) {
            const double x = in.get<std::uint8_t>() * 2.0;
            const auto kind = in.get<std::uint8_t>();
            StripReading reading{{{{x, 10}, {x + 50, 12}, {x + 50, 30}, {x, 28}}}, {}, 100};
            const auto time = in.get<std::uint16_t>();
            if (kind % 8 != 0)
                reading.time = time;
            readings.push_back(reading);
        }
        strips.add(film_ms, {640, 360}, readings);
    }
    const FilmStrips::Pair pair = strips.pair();
    if (!pair.problem.empty())
        return 0;
    const FilmLatency latency = latency_of(pair.frames, 60);
    if (!latency.problem.empty())
        return 0;
    for (const double figure : {latency.latency_ms.mean, latency.from_ms, latency.to_ms,
                                latency.age_ms.p95, latency.frames_per_second})
        if (!std::isfinite(figure))
            std::abort();
    return 0;
}
