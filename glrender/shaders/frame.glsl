// The uniforms of the frame, which all shaders share. Coordinates are along world axes, relative to
// the focus, a point on the view axis, which the CPU subtracts in double (frame.hpp). A ray is o +
// t·d, where d has the component 1 along the view axis: t is the depth beyond the focus' plane, and
// the Z channel is u_eye_distance + t.

uniform vec3 u_right, u_up, u_forward;
uniform vec2 u_half_extent;      // tan of the half angles, or half the width and height in world units
uniform float u_eye_distance;    // from the eye's plane to the focus
uniform float u_pixel_size;      // world size of a pixel: at depth 1 (perspective), anywhere (orthographic)
uniform float u_depth_scale;     // window depth = u_depth_scale·(u_far − t) [/ (u_eye_distance + t)]
uniform float u_far;             // t of the scene's far end
uniform float u_overlap;         // Subdivision::overlap
uniform vec2 u_viewport;         // pixels
uniform vec2 u_displacement;     // displacement of the rays from the pixels' centres, in pixels, y
                                 // upwards
