// SPDX-License-Identifier: Apache-2.0
// CameraSender: a camera in a session, whose frames are arrays.
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "encoded.h"
#include "sent_camera.h"
#include "waits.h"

namespace theatron::python {
namespace {

class SenderObject {
public:
    explicit SenderObject(std::unique_ptr<SentCamera> camera) : camera_(std::move(camera)) {}
    ~SenderObject() { close(); }
    SenderObject(const SenderObject&) = delete;
    SenderObject& operator=(const SenderObject&) = delete;

    std::shared_ptr<SentCamera> get() const {
        if (!camera_)
            throw Error("This camera was closed.");
        return camera_;
    }

    void send(const py::object& depth, const py::object& color,
              const std::optional<py::bytes>& jpeg, double age) const {
        const std::shared_ptr<SentCamera> camera = get();
        if (!color.is_none() && jpeg)
            throw py::value_error("Give either color or jpeg, not both.");
        constexpr double longest_age = 10;
        if (!(age >= 0 && age <= longest_age))
            throw py::value_error("age is the time since the exposure in seconds, 0 to 10.");
        const DepthArray depth_array = depth_argument(depth);
        const std::optional<ColorArray> color_array =
            color.is_none() ? std::nullopt : std::optional(color_argument(color));
        const ByteView jpeg_bytes = jpeg ? view_of(*jpeg) : ByteView{};
        const DepthView depth_view = view_of(depth_array);
        const ColorView color_view = color_array ? view_of(*color_array) : ColorView{};

        const py::gil_scoped_release released;
        std::shared_ptr<Frame> frame = camera->empty_frame();
        frame->depth.resize(depth_view.size);
        copy_pixels(depth_view, frame->depth.view());
        frame->color.jpeg.assign(jpeg_bytes.begin(), jpeg_bytes.end());
        frame->color.pixels.resize(color_view.size);
        copy_pixels(color_view, frame->color.pixels.view());
        camera->send(std::move(frame), seconds_to_duration(age));
    }

    // Needs Python's lock.
    void close() {
        auto camera = std::exchange(camera_, nullptr);
        const py::gil_scoped_release released;
        camera.reset();
    }

private:
    std::shared_ptr<SentCamera> camera_;
};

std::unique_ptr<SenderObject> send_camera(const std::string& link, const Calibration& calibration,
                                          const std::string& camera, double fps,
                                          const std::string& name, bool may_record) {
    if (!(fps >= 0.1 && fps <= 240))
        throw py::value_error("fps is 0.1 to 240 frames per second.");
    std::unique_ptr<SentCamera> sent;
    {
        const py::gil_scoped_release released;
        sent = std::make_unique<SentCamera>(
            SentCamera::Options{link, name, {camera, calibration, fps}, may_record});
    }
    auto object = std::make_unique<SenderObject>(std::move(sent));
    const std::shared_ptr<SentCamera> waiting = object->get();
    wait_until([&] { return waiting->is_in_session(); });
    return object;
}

}  // namespace

void bind_sending(py::module_& module) {
    py::class_<SenderObject>(module, "CameraSender",
                             "A camera in a session, whose frames are arrays.")
        .def("send", &SenderObject::send, py::arg("depth"), py::arg("color") = py::none(),
             py::kw_only(), py::arg("jpeg") = py::none(), py::arg("age") = 0.0,
             "Sends a frame to everybody who sees the camera. Does not wait for the network.")
        .def_property_readonly("is_wanted",
                               [](const SenderObject& self) { return self.get()->is_wanted(); })
        .def_property_readonly("taken",
                               [](const SenderObject& self) { return self.get()->taken(); })
        .def_property_readonly("replaced",
                               [](const SenderObject& self) { return self.get()->replaced(); })
        .def("close", &SenderObject::close, "Takes the camera out of the session.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](SenderObject& self, const py::args&) { self.close(); });
    module.def("send_camera", &send_camera, py::arg("link"), py::arg("calibration"), py::kw_only(),
               py::arg("camera") = "camera", py::arg("fps") = 30.0, py::arg("name") = "python",
               py::arg("may_record") = false,
               "Brings a camera into a session, with the host's link for those who may send.");
}

}  // namespace theatron::python
