// SPDX-License-Identifier: Apache-2.0
#include "net/sealed_media.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/error.h"

namespace theatron::net {
namespace {

constexpr std::size_t nonce_size = 12, tag_size = 16;

void check_seal(bool done) {
    if (!done)
        throw Error("OpenSSL cannot seal pictures here; is there memory?");
}

// Each hop writes `sent` anew: it is not sealed.
std::array<std::byte, wire::media_header_size> sealed_head(ByteView header, TimePoint captured) {
    std::array<std::byte, wire::media_header_size> head;
    std::copy_n(header.begin(), head.size(), head.begin());
    wire::stamp_sent(head, captured);
    return head;
}

// The number of the key and the count, as they are behind the payload.
std::array<std::byte, nonce_size> nonce_of(std::uint32_t number, std::uint64_t count) {
    std::array<std::byte, nonce_size> nonce;
    store_le(nonce.data(), number);
    store_le(nonce.data() + 4, count);
    return nonce;
}

}  // namespace

MediaSealer::MediaSealer(std::uint32_t key_number, ByteView key)
    : number_(key_number), cipher_(EVP_CIPHER_CTX_new()) {
    assert(key.size() == media_seal_key_size);
    check_seal(cipher_ && EVP_EncryptInit_ex(cipher_.get(), EVP_aes_256_gcm(), nullptr,
                                             raw(key.data()), nullptr) == 1);
}

Bytes MediaSealer::seal(wire::MediaHeader header, ByteView payload) {
    header.payload_size = std::uint32_t(payload.size() + media_seal_size);
    header.sent = header.captured;
    Bytes message(wire::media_header_size + header.payload_size);
    wire::write_media_header(header, message.data());
    const auto head = sealed_head(message, header.captured);
    const auto nonce = nonce_of(number_, ++count_);
    std::byte* sealed = message.data() + wire::media_header_size;
    std::byte* trailer = sealed + payload.size();
    int written = 0;
    check_seal(
        EVP_EncryptInit_ex(cipher_.get(), nullptr, nullptr, nullptr, raw(nonce.data())) == 1 &&
        EVP_EncryptUpdate(cipher_.get(), nullptr, &written, raw(head.data()), int(head.size())) ==
            1 &&
        EVP_EncryptUpdate(cipher_.get(), raw(sealed), &written, raw(payload.data()),
                          int(payload.size())) == 1 &&
        EVP_EncryptFinal_ex(cipher_.get(), raw(sealed) + written, &written) == 1 &&
        EVP_CIPHER_CTX_ctrl(cipher_.get(), EVP_CTRL_GCM_GET_TAG, int(tag_size),
                            trailer + nonce_size) == 1);
    std::copy(nonce.begin(), nonce.end(), trailer);
    return message;
}

void MediaOpener::add_key(std::uint32_t number, ByteView key) {
    assert(key.size() == media_seal_key_size);
    keys_[number] = Bytes(key.begin(), key.end());
    while (keys_.size() > 2)
        keys_.erase(keys_.begin());
}

std::optional<Bytes> MediaOpener::open(ByteView message, Failure& failure) {
    failure = Failure::forged;
    auto header = wire::parse_media_header(message);
    if (!header || header->payload_size < media_seal_size)
        return std::nullopt;
    const ByteView trailer = message.last(media_seal_size);
    const auto number = load_le<std::uint32_t>(trailer.data());
    const auto count = load_le<std::uint64_t>(trailer.data() + 4);
    const auto key = keys_.find(number);
    if (key == keys_.end()) {
        failure = Failure::unknown_key;
        return std::nullopt;
    }
    const auto newest = newest_.find(header->stream);
    if (newest != newest_.end() && std::pair(number, count) <= newest->second) {
        failure = Failure::repeated;
        return std::nullopt;
    }
    if (!cipher_ || cipher_key_ != number) {
        cipher_.reset(EVP_CIPHER_CTX_new());
        cipher_key_ = number;
        if (!cipher_ || EVP_DecryptInit_ex(cipher_.get(), EVP_aes_256_gcm(), nullptr,
                                           raw(key->second.data()), nullptr) != 1)
            return std::nullopt;
    }
    const std::size_t size = header->payload_size - media_seal_size;
    const auto head = sealed_head(message, header->captured);
    Bytes opened(wire::media_header_size + size);
    std::array<std::byte, tag_size> tag;
    std::copy_n(trailer.begin() + nonce_size, tag_size, tag.begin());
    int written = 0;
    if (EVP_DecryptInit_ex(cipher_.get(), nullptr, nullptr, nullptr, raw(trailer.data())) != 1 ||
        EVP_CIPHER_CTX_ctrl(cipher_.get(), EVP_CTRL_GCM_SET_TAG, int(tag_size), tag.data()) != 1 ||
        EVP_DecryptUpdate(cipher_.get(), nullptr, &written, raw(head.data()), int(head.size())) !=
            1 ||
        EVP_DecryptUpdate(cipher_.get(), raw(opened.data() + wire::media_header_size), &written,
                          raw(message.data() + wire::media_header_size), int(size)) != 1 ||
        EVP_DecryptFinal_ex(cipher_.get(), raw(opened.data() + wire::media_header_size) + written,
                            &written) != 1)
        return std::nullopt;
    newest_[header->stream] = {number, count};
    header->payload_size = std::uint32_t(size);
    wire::write_media_header(*header, opened.data());
    return opened;
}

}  // namespace theatron::net
