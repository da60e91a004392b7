# SPDX-License-Identifier: Apache-2.0
"""docs/formats/depth_strata.md: pixel by pixel, in the order of the page."""

import struct
from bisect import bisect_left, bisect_right

from payload import STRATA, Header, need
from strata_side import SideReader, read_levels, read_values, slots_of, standard_levels

LANES, LAG, LEAST, TOP = 32, 4, 1 << 15, 0xFFFF
TAIL = LAG * (LANES - 1)  # steps from lane 0 to lane 31
DELTA, BLEND, RANKS, BOUNDED = 1, 2, 4, 8
ACTIVITY = (1, 2, 3, 6, 12, 24, 48, 96, 192)
TOKEN_LOW, TOKEN_HIGH = 2, 50
# The number of bits that follow each token, and the bits in front of them.
EXTRA_BITS = [15 if t in (TOKEN_LOW, TOKEN_HIGH) else (t - 18) // 2 - 1 if t >= 27 else 0 for t in range(51)]


def signed(v):
    return ((v & TOP) ^ 0x8000) - 0x8000


class Frame:
    """State that later frames need of a frame. Rows are indexed from -2 on by y + 2 and by position."""

    def __init__(self, width, height):
        self.rows = -(-height // LANES) * LANES
        self.pitch = max(width + 4, 136)
        self.depth = [[0] * self.pitch for _ in range(self.rows + 3)]
        self.valid = [[0] * self.pitch for _ in range(self.rows + 3)]
        self.values = []
        self.levels = None
        self.size = (width, height)

    def repeat_below(self):
        """Rows below the image; of the row after the last group what lane 0 gets to."""
        height = self.size[1]
        for plane in (self.depth, self.valid):
            for y in range(height, self.rows):
                plane[y + 2] = plane[y + 1]
            last = plane[self.rows + 1]
            plane[self.rows + 2] = last[:TAIL] + [0] * (self.pitch - TAIL)


class Payload:
    def __init__(self, encoded):
        header = Header(encoded, STRATA, flags=15)
        need(header.parameter == 0, "a parameter")
        self.width, self.height, self.flags = header.width, header.height, header.flags
        self.at, self.encoded = 8, encoded
        side_bytes, word_count = self.take("<II")
        self.constant = self.squared = 0
        self.polygons = []
        if self.flags & BOUNDED:
            self.constant, self.squared, polygons = self.take("<BBB")
            need(self.squared <= 15 and self.constant + self.squared > 0, "a tolerance out of range")
            need(polygons <= 16 and not self.flags & RANKS, "too many polygons, or ranks beside a tolerance")
            for _ in range(polygons):
                (corners,) = self.take("<B")
                need(3 <= corners <= 32, "corners out of range")
                self.polygons.append([self.take("<HH") for _ in range(corners)])
        self.weights = self.take("<11h" if self.flags & DELTA else "<6h")
        self.states = list(self.take("<32I"))
        need(all(LEAST <= s < 1 << 31 for s in self.states), "a state out of range")
        self.side = bytes(self.take(f"<{side_bytes}B"))
        self.words = list(self.take(f"<{word_count}H"))
        need(self.at == len(encoded), "bytes are left over")

    def take(self, layout):
        need(self.at + struct.calcsize(layout) <= len(self.encoded), "ends early")
        values = struct.unpack_from(layout, self.encoded, self.at)
        self.at += struct.calcsize(layout)
        return values


def in_region(polygons, x, y):
    """Even-odd; centres on an edge count as right of it."""
    for corners in polygons:
        inside = False
        for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
            if (2 * y0 > 2 * y + 1) != (2 * y1 > 2 * y + 1):
                # (2y + 1 - 2 y0) / (2 y1 - 2 y0) of the way; compared without division.
                way, whole = 2 * y + 1 - 2 * y0, 2 * (y1 - y0)
                off = (2 * x + 1 - 2 * x0) * whole - 2 * (x1 - x0) * way
                inside ^= off >= 0 if whole > 0 else off <= 0
        if inside:
            return True
    return False


def moved(depth, added, before):
    """Ranks of a reference after values were added: bounds are ranks of its own list."""
    bounds = [256 + bisect_left(before, value) for value in added]
    return [[d + bisect_right(bounds, d) & TOP for d in row] for row in depth]


class Decoder:
    def __init__(self, payload, before, levels):
        self.p, self.before = payload, before
        self.frame = Frame(payload.width, payload.height)
        self.slots = [slots_of(tuple(context)) for context in levels]
        planes = self.frame.rows + 2
        self.residual = [[0] * self.frame.pitch for _ in range(planes)]
        self.errors = [[(0, 0, 0, 0)] * self.frame.pitch for _ in range(planes)]
        self.out = [[0] * payload.width for _ in range(payload.height)]

    def tolerance(self, depth, x, y):
        if in_region(self.p.polygons, x, y):
            return 0
        return min(2047, self.p.constant + self.p.squared * ((depth * depth >> 16) >> 4) & TOP)

    def fill_beside(self, y, position):
        """Positions in front of a row before its first pixel, behind it after its last."""
        r = y + 2
        for plane in (self.frame.depth, self.frame.valid):
            if position == 2:
                plane[r][0], plane[r][1] = plane[r - 1][1], plane[r - 1][2]
            if position == self.p.width + 1:
                plane[r][position + 1] = plane[r][position + 2] = plane[r][position]

    def predict(self, r, i):
        """Prediction, context, whether the sign is turned, and the candidates."""
        row, up, up2 = self.frame.depth[r], self.frame.depth[r - 1], self.frame.depth[r - 2]
        w, n, nw = row[i - 1], up[i], up[i - 1]
        mean = w + n + 1 >> 1
        low, high = (w, n) if w < n else (n, w)
        median = max(low, min(high, w + n - nw & TOP))
        taps = [w, nw, up[i + 1], row[i - 2], up2[i], up[i + 2]]
        b = self.before
        if b:
            old, oldest = b.depth[r], b.depth[r - 1]
            p, pw, pn = old[i], old[i - 1], oldest[i]
            taps += [p, pw, pn, old[i + 1], b.depth[r + 1][i]]
        total = 4
        for tap, weight in zip(taps, self.p.weights):
            total += signed((tap - mean) * 8) * weight + 0x4000 >> 15
        linear = mean + (signed(total) >> 3) & TOP
        if b:
            candidates = (median, p, p + (signed(w - pw + n - pn) >> 1) & TOP, linear)
        else:
            candidates = (median, w, n, linear)

        prediction = median
        if self.p.flags & BLEND:
            here, above = self.errors[r], self.errors[r - 1]
            e = [sum(five) for five in zip(here[i - 1], here[i - 2], above[i], above[i - 1], above[i + 1])]
            one, two = (1 if e[1] < e[0] else 0), (3 if e[3] < e[2] else 2)
            best, other = (two, one) if e[two] < e[one] else (one, two)
            partner = best ^ 1
            second = partner if e[partner] < e[other] else other
            prediction = candidates[best]
            if 2 * e[second] < 3 * e[best]:
                prediction = prediction + candidates[second] + 1 >> 1

        aside = signed(linear - prediction)
        side = 0 if aside == 0 else 1 if abs(aside) < 4 else 2
        res, res_up = self.residual[r], self.residual[r - 1]
        activity = bisect_right(ACTIVITY, 2 * res[i - 1] + 2 * res_up[i] + res_up[i - 1] + res_up[i + 1])
        ok, ok_up = self.frame.valid[r], self.frame.valid[r - 1]
        t = 3
        if b:
            t = 2 * b.valid[r][i] + (b.valid[r][i + 1] & b.valid[r + 1][i])
        v = 4 * (2 * ok[i - 1] + 2 * ok_up[i] + ok_up[i - 1] + ok_up[i + 1]) + t
        context = 3 * activity + side if v == 27 else 30 + v
        return prediction, context, aside < 0, candidates

    def keep(self, y, i, predicted, token, extra):
        prediction, _, turned, candidates = predicted
        r, x = y + 2, i - 2
        depth, residual, filled = 0, 0, prediction
        if token == 1:
            depth = TOP
        elif token in (TOKEN_LOW, TOKEN_HIGH):
            need(self.p.flags & BOUNDED, "a token that occurs only in bounded frames")
            depth = filled = extra + (0x8000 if token == TOKEN_HIGH else 0)
            residual = 255
        elif token > 2:
            code = token - 3
            if token >= 27:
                h = token - 18
                code = (2 | h & 1) << (h // 2 - 1) | extra
            difference = signed(-(code + 1 >> 1) if code & 1 else code >> 1)
            if turned:
                difference = signed(-difference)
            residual = min(255, abs(difference))
            if self.p.flags & BOUNDED:
                difference *= 2 * self.tolerance(prediction, x, y) + 1
            depth = filled = prediction + difference & TOP
        self.out[y][x] = depth
        self.frame.depth[r][i] = filled
        self.frame.valid[r][i] = int(token >= 2)
        self.residual[r][i] = residual
        if self.p.flags & BLEND:
            self.errors[r][i] = tuple(min(255, abs(signed(filled - c))) for c in candidates)

    def refill(self, lanes):
        states = self.p.states
        small = [lane for lane in lanes if states[lane] < LEAST]
        if not small:
            return
        need(len(small) <= len(self.p.words), "the words end early")
        last = self.p.words[-len(small):]
        del self.p.words[-len(small):]
        for lane, word in zip(small, last):
            states[lane] = states[lane] << 16 | word

    def decode(self):
        width, height, pitch = self.p.width, self.p.height, self.frame.pitch
        states = self.p.states
        for step in range(pitch * (self.frame.rows // LANES) + TAIL):
            work = []
            for lane in range(LANES):
                group, i = divmod(step - LAG * lane, pitch)
                y = LANES * group + lane
                if not (0 <= y < height and 2 <= i < width + 2):
                    continue
                if i == 2:
                    self.fill_beside(y, i)
                predicted = self.predict(y + 2, i)
                slot = states[lane] & 2047
                token, start, frequency = self.slots[predicted[1]][slot]
                states[lane] = (states[lane] >> 11) * frequency + slot - start
                work.append((lane, y, i, predicted, token))
            lanes = [w[0] for w in work]
            self.refill(lanes)
            extras = {}
            for lane, _, _, _, token in work:
                bits = EXTRA_BITS[token]
                if bits:
                    extras[lane] = states[lane] & (1 << bits) - 1
                    states[lane] >>= bits
            if extras:
                self.refill(lanes)
            for lane, y, i, predicted, token in work:
                self.keep(y, i, predicted, token, extras.get(lane, 0))
                if i == width + 1:
                    self.fill_beside(y, i)
        need(not self.p.words and all(s == LEAST for s in states), "another end than the encoder's")
        self.frame.repeat_below()
        return self.out


def decode_strata(encoded, before):
    """Pixels and what is to be remembered; `before` is that of the reference, or None."""
    payload = Payload(encoded)
    delta = payload.flags & DELTA != 0
    if delta:
        need(before is not None and before.size == (payload.width, payload.height), "no reference")
        need(bool(payload.flags & RANKS) == bool(before.values), "ranks without a list, or the other way round")
    else:
        before = None
    reader = SideReader(payload.side)
    values, reference = [], before
    if payload.flags & RANKS:
        old = before.values if before else []
        added, values = read_values(reader, old)
        if before and added:
            reference = Frame(payload.width, payload.height)
            reference.depth, reference.valid = moved(before.depth, added, old), before.valid
    levels = read_levels(reader, before.levels if before else standard_levels())
    reader.end()
    decoder = Decoder(payload, reference, levels)
    rows = decoder.decode()
    decoder.frame.values, decoder.frame.levels = values, levels
    pixels = [pixel for row in rows for pixel in row]
    if payload.flags & RANKS:
        pixels = [p if p in (0, TOP) else values[p - 256] if 256 <= p < 256 + len(values) else 0 for p in pixels]
    return pixels, decoder.frame
