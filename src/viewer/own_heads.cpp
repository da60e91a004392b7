// SPDX-License-Identifier: Apache-2.0
#include "viewer/own_heads.h"

#include <algorithm>
#include <utility>

#include "face/sent_face.h"
#include "video/jpeg_decoder.h"
#include "video/jpeg_header.h"

namespace theatron::viewer {
namespace {

bool decode(ByteView jpeg, video::BaselineJpegDecoder& decoder, ColorImage& out) {
    const auto size = video::read_jpeg_size(jpeg);
    return size && std::max(size->width, size->height) <= face::max_sent_texture_side &&
           decoder.decode(jpeg, out) == Status::ok;
}

}  // namespace

std::shared_ptr<const room::OwnHead> own_head_of(ByteView bytes) {
    auto face = face::parse_sent_face(bytes);
    if (!face)
        return nullptr;
    room::OwnHead::Textures textures;
    video::BaselineJpegDecoder decoder;
    for (std::size_t i = 0; i < textures.size(); ++i)
        if (!face->textures[i].empty() && !decode(face->textures[i], decoder, textures[i]))
            return nullptr;
    const Size size = textures[std::size_t(face::Emotion::neutral)].size;
    for (const ColorImage& texture : textures)
        if (!texture.empty() && texture.size != size)
            return nullptr;
    for (Bytes& jpeg : face->textures)
        jpeg = {};
    return std::make_shared<const room::OwnHead>(std::move(*face), std::move(textures));
}

bool OwnHeads::take(const client::FaceKeeper::Faces& faces) {
    const auto gone = std::erase_if(heads_, [&](const auto& known) {
        const auto found = faces.find(known.first);
        return found == faces.end() || found->second != known.second.bytes;
    });
    bool changed = gone > 0;
    for (const auto& [person, bytes] : faces) {
        if (heads_.contains(person) || heads_.size() >= max_own_heads)
            continue;
        Head head{bytes, own_head_of(*bytes)};
        damaged_ += head.head == nullptr;
        heads_.emplace(person, std::move(head));
        changed = true;
    }
    return changed;
}

std::shared_ptr<const room::OwnHead> OwnHeads::of(ParticipantId person) const {
    const auto found = heads_.find(person);
    return found == heads_.end() ? nullptr : found->second.head;
}

}  // namespace theatron::viewer
