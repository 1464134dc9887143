// torus.toml for POV-Ray: z is up, coordinates are right-handed.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 1 }
#declare Tall = tan(radians(36 / 2));
camera {
  location <1.2, -4.5, 2.6>
  sky z
  right -x * image_width / image_height
  angle degrees(2 * atan(Tall * image_width / image_height))
  look_at 0
}
background { rgb <0.125, 0.25, 0.5> }
light_source { <-6, -10, 12> rgb 1 }
torus {
  1, 0.4
  rotate 90 * x
  rotate 20 * x
  pigment { rgb <0.8, 0.2, 0.1> }
  finish { ambient 0.1 diffuse 0.8 phong 0.5 phong_size 40 }
}
