// SPDX-License-Identifier: Apache-2.0
#include <wels/codec_api.h>

#include <algorithm>

#include "base/error.h"
#include "video/avc_engine_native.h"

namespace theatron::video {
namespace {

constexpr float frames_per_second = 30;
// One block; the library refuses less.
constexpr int smallest_side = 16;

struct Deleter {
    void operator()(ISVCEncoder* encoder) const {
        encoder->Uninitialize();
        WelsDestroySVCEncoder(encoder);
    }
};

class OpenH264 final : public AvcEngine {
public:
    explicit OpenH264(const AvcParams& params) : params_(params) {}

    Status open(Size size, AvcLayout layout) override {
        encoder_.reset();
        size_ = {};
        if (layout != AvcLayout::yuv420 || size.width < smallest_side ||
            size.height < smallest_side)
            return Status::unsupported;
        ISVCEncoder* encoder = nullptr;
        if (WelsCreateSVCEncoder(&encoder) != 0 || !encoder)
            return Status::unsupported;
        encoder_.reset(encoder);
        int silent = WELS_LOG_QUIET;
        encoder->SetOption(ENCODER_OPTION_TRACE_LEVEL, &silent);
        SEncParamExt p;
        encoder->GetDefaultParams(&p);
        p.iUsageType = CAMERA_VIDEO_REAL_TIME;
        p.iPicWidth = size.width;
        p.iPicHeight = size.height;
        p.fMaxFrameRate = frames_per_second;
        const bool rated = params_.bitrate_mbit > 0;
        p.iRCMode = rated ? RC_BITRATE_MODE : RC_OFF_MODE;
        p.iTargetBitrate = rated ? int(params_.bitrate_mbit * 1e6) : UNSPECIFIED_BIT_RATE;
        p.iMaxBitrate = p.iTargetBitrate;
        p.bEnableFrameSkip = false;
        p.iTemporalLayerNum = 1;
        p.iSpatialLayerNum = 1;
        p.iComplexityMode = LOW_COMPLEXITY;
        p.uiIntraPeriod = 0;  // key frames come when they are asked for, and only then
        p.iNumRefFrame = 1;
        p.eSpsPpsIdStrategy = CONSTANT_ID;
        p.iMultipleThreadIdc = 1;
        p.bEnableDenoise = false;
        p.bEnableBackgroundDetection = true;
        p.bEnableAdaptiveQuant = false;
        p.bEnableSceneChangeDetect = false;
        p.iEntropyCodingModeFlag = 0;
        p.iLoopFilterDisableIdc = 0;
        SSpatialLayerConfig& layer = p.sSpatialLayers[0];
        layer.iVideoWidth = size.width;
        layer.iVideoHeight = size.height;
        layer.fFrameRate = frames_per_second;
        layer.iSpatialBitrate = p.iTargetBitrate;
        layer.iMaxSpatialBitrate = p.iMaxBitrate;
        layer.iDLayerQp = params_.crf;  // of every picture, while there is no rate
        layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
        // The colour space of JPEG, so that decoders elsewhere convert alike.
        layer.bVideoSignalTypePresent = true;
        layer.uiVideoFormat = VF_UNDEF;
        layer.bFullRange = true;
        layer.bColorDescriptionPresent = true;
        layer.uiColorPrimaries = CP_BT709;
        layer.uiTransferCharacteristics = TRC_IEC61966_2_1;
        layer.uiColorMatrix = CM_SMPTE170M;
        if (encoder->InitializeExt(&p) != 0)
            return Status::unsupported;
        size_ = size;
        // Luma, then both chroma planes; rows of whole cache lines.
        stride_ = (size.width + 63) / 64 * 64;
        pixels_.assign(std::size_t(stride_) * std::size_t(size.height) * 3 / 2, 0);
        first_ = true;
        return Status::ok;
    }

    Size size() const override { return size_; }

    AvcPlanes planes() override {
        std::uint8_t* const luma = pixels_.data();
        std::uint8_t* const blue = luma + std::ptrdiff_t(stride_) * size_.height;
        std::uint8_t* const red = blue + std::ptrdiff_t(stride_) / 2 * (size_.height / 2);
        return {{{luma, stride_}, {blue, stride_ / 2}, {red, stride_ / 2}}};
    }

    Result<AvcEncoder::Encoded> encode(bool key) override {
        // The first one is a key frame by itself; if it were asked for, the second would be
        // another.
        if (!std::exchange(first_, false) && key)
            encoder_->ForceIntraFrame(true);
        SSourcePicture picture{};
        picture.iColorFormat = videoFormatI420;
        picture.iPicWidth = size_.width;
        picture.iPicHeight = size_.height;
        const AvcPlanes from = planes();
        for (std::size_t i = 0; i < from.size(); ++i) {
            picture.pData[i] = from[i].pixels;
            picture.iStride[i] = int(from[i].stride);
        }
        picture.uiTimeStamp = (number_++ * 1000) / int(frames_per_second);
        SFrameBSInfo info{};
        if (encoder_->EncodeFrame(&picture, &info) != 0 || info.eFrameType == videoFrameTypeSkip ||
            info.eFrameType == videoFrameTypeInvalid)
            return Status::unsupported;
        bytes_.clear();
        for (int i = 0; i < info.iLayerNum; ++i) {
            const SLayerBSInfo& layer = info.sLayerInfo[i];
            std::size_t size = 0;
            for (int n = 0; n < layer.iNalCount; ++n)
                size += std::size_t(layer.pNalLengthInByte[n]);
            const auto* begin = reinterpret_cast<const std::byte*>(layer.pBsBuf);
            bytes_.insert(bytes_.end(), begin, begin + size);
        }
        return AvcEncoder::Encoded{bytes_, info.eFrameType == videoFrameTypeIDR};
    }

private:
    const AvcParams params_;
    std::unique_ptr<ISVCEncoder, Deleter> encoder_;
    Size size_;
    int stride_ = 0;
    std::vector<std::uint8_t> pixels_;
    Bytes bytes_;
    long long number_ = 0;
    bool first_ = true;
};

}  // namespace

bool has_openh264() {
    return true;
}

std::unique_ptr<AvcEngine> make_openh264(const AvcParams& params) {
    return std::make_unique<OpenH264>(params);
}

}  // namespace theatron::video
