// SPDX-License-Identifier: Apache-2.0
#include <cuda_runtime.h>

#include <cstring>
#include <string>
#include <vector>

#include "filter/cuda_chain.h"
#include "filter/frame_gap.h"
#include "filter/parallel_chain.h"

namespace theatron::filter {
namespace {

template <class Body>
__global__ void for_each_pixel(int left, int top, int right, int bottom, Body body) {
    const int x = left + int(blockIdx.x * blockDim.x + threadIdx.x);
    const int y = top + int(blockIdx.y * blockDim.y + threadIdx.y);
    if (x < right && y < bottom)
        body(x, y);
}

// One stream for one camera. The first error is stored, and all later calls do nothing.
class CudaLauncher {
public:
    struct Atomics {
        __host__ __device__ static int min(int* at, int value) {
#ifdef __CUDA_ARCH__
            return atomicMin(at, value);
#else
            return *at = value < *at ? value : *at;
#endif
        }
        __host__ __device__ static void add(int* at, int value) {
#ifdef __CUDA_ARCH__
            atomicAdd(at, value);
#else
            *at += value;
#endif
        }
    };

    CudaLauncher() {
        keep(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    }
    ~CudaLauncher() {
        for (void* memory : memories_)
            cudaFree(memory);
        for (void* memory : pinned_)
            cudaFreeHost(memory);
        if (stream_ != nullptr)
            cudaStreamDestroy(stream_);
    }
    CudaLauncher(const CudaLauncher&) = delete;
    CudaLauncher& operator=(const CudaLauncher&) = delete;

    template <class T>
    T* allocate(std::size_t count) {
        void* memory = nullptr;
        keep(cudaMalloc(&memory, count * sizeof(T)));
        if (memory == nullptr)
            return nullptr;
        memories_.push_back(memory);
        keep(cudaMemsetAsync(memory, 0, count * sizeof(T), stream_));
        return static_cast<T*>(memory);
    }
    // Memory of the processor that the device copies from and to by itself; null if exhausted.
    std::uint16_t* allocate_pinned(std::size_t count) {
        void* memory = nullptr;
        keep(cudaMallocHost(&memory, bytes(std::ptrdiff_t(count))));
        if (memory != nullptr)
            pinned_.push_back(memory);
        return static_cast<std::uint16_t*>(memory);
    }
    void clear(std::uint16_t* pixels, std::size_t count) {
        if (ok())
            keep(cudaMemsetAsync(pixels, 0, count * sizeof(*pixels), stream_));
    }
    template <class Body>
    void launch(int left, int top, int right, int bottom, const Body& body) {
        if (!ok())
            return;
        const dim3 block(32, 8);  // a warp reads one row
        const dim3 grid((unsigned(right - left) + block.x - 1) / block.x,
                        (unsigned(bottom - top) + block.y - 1) / block.y);
        for_each_pixel<<<grid, block, 0, stream_>>>(left, top, right, bottom, body);
        keep(cudaGetLastError());
    }
    void upload(DepthView in, const ParallelImage& image) {
        if (ok())
            keep(cudaMemcpy2DAsync(image.pixels, bytes(image.pitch), in.pixels, bytes(in.stride),
                                   bytes(in.size.width), std::size_t(in.size.height),
                                   cudaMemcpyHostToDevice, stream_));
    }
    void download(const ParallelImage& image, MutableDepthView out) {
        if (ok())
            keep(cudaMemcpy2DAsync(out.pixels, bytes(out.stride), image.pixels, bytes(image.pitch),
                                   bytes(out.size.width), std::size_t(out.size.height),
                                   cudaMemcpyDeviceToHost, stream_));
    }
    void wait() {
        keep(cudaStreamSynchronize(stream_));
    }
    bool ok() const {
        return error_ == cudaSuccess;
    }
    cudaError_t error() const {
        return error_;
    }

private:
    static std::size_t bytes(std::ptrdiff_t pixels) {
        return std::size_t(pixels) * sizeof(std::uint16_t);
    }
    void keep(cudaError_t error) {
        if (error_ == cudaSuccess)
            error_ = error;
    }

    cudaStream_t stream_ = nullptr;
    cudaError_t error_ = cudaSuccess;
    std::vector<void*> memories_, pinned_;
};

class GpuChain final : public CudaChain {
public:
    GpuChain(const ChainSettings& settings, const ChainCamera& camera)
        : size_(camera.size),
          in_(launcher_.allocate_pinned(camera.size.area())),
          out_(launcher_.allocate_pinned(camera.size.area())),
          chain_(settings, camera, launcher_) {
        // The caller may destroy the background after the constructor returns.
        launcher_.wait();
    }

    std::optional<DepthView> apply(DepthView in, Duration since_last_frame) override {
        if (!launcher_.ok())
            return std::nullopt;
        const FrameGap::Meaning gap = gap_.next(since_last_frame);
        for (int y = 0; y < size_.height; ++y)
            std::memcpy(in_ + std::ptrdiff_t(y) * size_.width, in.row(y),
                        std::size_t(size_.width) * sizeof(*in_));
        chain_.apply(DepthView(in_, size_, size_.width), MutableDepthView(out_, size_, size_.width),
                     gap.forgets, gap.missed);
        launcher_.wait();
        if (!launcher_.ok())
            return std::nullopt;
        return DepthView(out_, size_, size_.width);
    }
    std::string device() const override { return device_; }
    cudaError_t error() const { return launcher_.error(); }

private:
    static std::string name_of_device() {
        cudaDeviceProp properties{};
        int device = 0;
        if (cudaGetDevice(&device) != cudaSuccess ||
            cudaGetDeviceProperties(&properties, device) != cudaSuccess)
            return "a CUDA device";
        return properties.name;
    }

    const std::string device_ = name_of_device();
    const Size size_;
    CudaLauncher launcher_;
    std::uint16_t *const in_, *const out_;  // of a whole frame, in rows
    ParallelChain<CudaLauncher> chain_;
    FrameGap gap_;
};

}  // namespace

std::unique_ptr<CudaChain> CudaChain::make(const ChainSettings& settings, const ChainCamera& camera,
                                           std::string& problem) {
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        problem = "No CUDA device answers.";
        return nullptr;
    }
    auto chain = std::make_unique<GpuChain>(settings, camera);
    if (chain->error() != cudaSuccess) {
        problem = std::string("The CUDA device fails: ") + cudaGetErrorString(chain->error()) + ".";
        return nullptr;
    }
    return chain;
}

}  // namespace theatron::filter
