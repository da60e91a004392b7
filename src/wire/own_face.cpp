// SPDX-License-Identifier: Apache-2.0
#include "wire/own_face.h"

#include <algorithm>

namespace theatron::wire {

Bytes encode_own_face(const OwnFace& face) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(std::uint8_t(face.kind));
    if (face.kind == OwnFace::Kind::none)
        return bytes;
    out.put(face.bytes);
    out.put_bytes(face.hash.bytes);
    return bytes;
}

Result<OwnFace> decode_own_face(ByteView bytes) {
    if (bytes.empty())
        return Status::truncated;
    ByteReader in(bytes);
    const unsigned kind = in.get<std::uint8_t>();
    if (kind > unsigned(OwnFace::Kind::received))
        return Status::malformed;
    OwnFace face;
    face.kind = OwnFace::Kind(kind);
    if (face.kind == OwnFace::Kind::none)
        return in.rest().empty() ? Result(face) : Status::trailing_bytes;
    face.bytes = in.get<std::uint32_t>();
    const ByteView hash = in.get_bytes(ContentHash::size);
    if (!in.ok())
        return Status::truncated;
    std::copy(hash.begin(), hash.end(), face.hash.bytes.begin());
    if (face.bytes > max_own_face_bytes || (face.bytes == 0 && kind == 1))
        return Status::malformed;
    return in.rest().empty() ? Result(face) : Status::trailing_bytes;
}

}  // namespace theatron::wire
