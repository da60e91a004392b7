// SPDX-License-Identifier: Apache-2.0
#include "xr/window_input.h"

namespace theatron::xr {

const std::vector<KeyHelp>& key_help() {
    static const std::vector<KeyHelp> help = {
        {"Left mouse button, drag", "Turn around what is under the mouse"},
        {"Right mouse button, drag", "Move sideways, up and down"},
        {"Mouse wheel", "Come closer, go further away; over a list: move it"},
        {"W A S D, Q E", "Walk; Q down, E up; faster with Shift"},
        {"Left mouse button on an object",
         "Hold it; wheel: nearer, further; Shift and wheel: turn; a screen: + and - its width"},
        {"N; G; Delete", "A new brick; give what you hold to the nearest person; remove it"},
        {"T, held", "Aim at a place on the floor with the mouse; release to stand there"},
        {"X", "Sit or stand"},
        {"L", "Close or open your microphone (join --microphone)"},
        {"F7; Enter, held", "Push to talk, or an open microphone; speak"},
        {"F8", "Agree that others record your voice, or no longer"},
        {"F4", "Show your face on your avatar with your webcam, or no longer"},
        {"P", "People, shared screens and places: go to somebody, see through their eyes"},
        {"O", "The case: open it, its parts, cuts and images"},
        {"Shift and left button on an organ", "Hold the part under the mouse; Delete hides it"},
        {"Wheel, left button on images", "Another slice; drag: another window"},
        {"I", "The slice through the place under the mouse; on a slice: the next plane"},
        {"Z; Backspace", "Marks: draw, point at places, measure; remove your newest mark"},
        {"F, held", "Point at what is under the mouse: the others see it with your name"},
        {"K, J", "Call the others to you; go to the person who calls you"},
        {"Y, U", "Operators: let in the person at the door, or refuse"},
        {"R or Home", "Back to the camera's own view"},
        {"1 to 9", "View of the first camera (0) to the ninth (8)"},
        {"F2", "Plain pictures of the cameras: colour, depth, both; click: large"},
        {"0; + and -", "From above; larger and smaller points"},
        {"Space", "Freeze the picture of the cameras, live again"},
        {"F5; comma, full stop", "The host's recording, for all: pause, play; 5 s back, forward"},
        {"Comma; full stop; End", "Without one, you alone: look 10 s back; nearer; live again"},
        {"F6", "Operators: move and turn a camera a little, for all"},
        {"Arrows, Page Up and Down, [ ]",
         "Then: its picture left, right, away, near, up, down, turned"},
        {"F9, F10", "Save a picture (PNG), the points of the cameras (PLY)"},
        {"M or Tab", "Next way of drawing"},
        {"C, V", "Next depth codec, next colour codec"},
        {"F11", "Full screen"},
        {"B", "Show or hide the line of facts"},
        {"H or F1", "Show or hide this help"},
        {"Esc, twice", "Leave the session; once: leave full screen"},
    };
    return help;
}

}  // namespace theatron::xr
