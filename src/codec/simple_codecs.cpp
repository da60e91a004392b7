// SPDX-License-Identifier: Apache-2.0
#include "codec/simple_codecs.h"

#include "codec/ans.h"
#include "codec/raw.h"
#include "codec/remember.h"
#include "codec/rvl.h"
#include "codec/trvl.h"

namespace theatron::codec {
namespace {

class RawCodec final : public DepthCodec {
public:
    bool lossless() const override { return true; }
    bool temporal() const override { return false; }
    std::size_t max_encoded_size(Size size) const override { return raw::encoded_size(size); }
    std::size_t encode(DepthView depth, const Reference*, std::span<std::byte> out,
                       Reference*) override {
        return raw::encode(depth, out);
    }
    Result<Size> read_size(ByteView encoded) const override { return raw::read_size(encoded); }
    Status decode(ByteView encoded, const Reference*, MutableDepthView out, Reference*) override {
        return raw::decode(encoded, out);
    }
};

class RvlCodec final : public DepthCodec {
public:
    bool lossless() const override { return true; }
    bool temporal() const override { return false; }
    std::size_t max_encoded_size(Size size) const override { return rvl::max_encoded_size(size); }
    std::size_t encode(DepthView depth, const Reference*, std::span<std::byte> out,
                       Reference*) override {
        if (depth.contiguous())
            return rvl::encode(depth, out);
        scratch_.resize(depth.size);
        copy_rows(depth, scratch_.view());
        return rvl::encode(scratch_.view(), out);
    }
    Result<Size> read_size(ByteView encoded) const override { return rvl::read_size(encoded); }
    Status decode(ByteView encoded, const Reference*, MutableDepthView out, Reference*) override {
        if (out.contiguous())
            return rvl::decode(encoded, out);
        scratch_.resize(out.size);
        const Status status = rvl::decode(encoded, scratch_.view());
        if (status == Status::ok)
            copy_rows(scratch_.view(), out);
        return status;
    }

private:
    DepthImage scratch_;
};

class TrvlCodec final : public DepthCodec {
public:
    bool lossless() const override { return true; }
    bool temporal() const override { return true; }
    std::size_t max_encoded_size(Size size) const override { return trvl::max_encoded_size(size); }
    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override {
        scratch_.resize(depth.size.area());
        const std::size_t used = trvl::encode(depth, view_of(reference), scratch_, out);
        remember(depth, next);
        return used;
    }
    Result<Size> read_size(ByteView encoded) const override { return trvl::read_size(encoded); }
    Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                  Reference* next) override {
        scratch_.resize(out.size.area());
        const Status status = trvl::decode(encoded, view_of(reference), scratch_, out);
        if (status == Status::ok)
            remember(out, next);
        return status;
    }

private:
    std::vector<std::uint16_t> scratch_;
};

class AnsCodec final : public DepthCodec {
public:
    explicit AnsCodec(bool delta) : delta_(delta) {}
    bool lossless() const override { return true; }
    bool temporal() const override { return delta_; }
    std::size_t max_encoded_size(Size size) const override { return ans::max_encoded_size(size); }
    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override {
        const DepthView before = delta_ ? view_of(reference) : DepthView{};
        const std::size_t used = ans::encode(depth, before, work_, out);
        if (delta_)
            remember(depth, next);
        return used;
    }
    Result<Size> read_size(ByteView encoded) const override { return ans::read_size(encoded); }
    Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                  Reference* next) override {
        const Status status = ans::decode(encoded, view_of(reference), work_, out);
        if (status == Status::ok && delta_)
            remember(out, next);
        return status;
    }

private:
    ans::DepthWorkspace work_;
    bool delta_;
};

}  // namespace

std::unique_ptr<DepthCodec> make_raw() {
    return std::make_unique<RawCodec>();
}
std::unique_ptr<DepthCodec> make_rvl() {
    return std::make_unique<RvlCodec>();
}
std::unique_ptr<DepthCodec> make_trvl() {
    return std::make_unique<TrvlCodec>();
}
std::unique_ptr<DepthCodec> make_ans(bool delta) {
    return std::make_unique<AnsCodec>(delta);
}

}  // namespace theatron::codec
