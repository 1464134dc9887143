// primitives.toml for POV-Ray: z is up, coordinates are right-handed.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }
#declare Tall = tan(radians(30 / 2));
camera {
  location <0.8, -8.5, 4.2>
  sky z
  right -x * image_width / image_height
  angle degrees(2 * atan(Tall * image_width / image_height))
  look_at <0, 0, 0.6>
}
background { rgb <0.25, 0.4, 0.7> }
light_source { <-6, -10, 12> rgb 0.75 }
light_source { <8, -6, 9> rgb <0.25, 0.25, 0.3> }
#declare Matt = finish { ambient 0.1 diffuse 0.8 }
#declare Shiny = finish { ambient 0.1 diffuse 0.8 phong 0.5 phong_size 40 }
#declare Red = texture { pigment { rgb <0.8, 0.2, 0.1> } finish { Shiny } }
#declare Green = texture { pigment { rgb <0.2, 0.6, 0.2> } finish { Shiny } }
#declare Blue = texture { pigment { rgb <0.2, 0.3, 0.8> } finish { Shiny } }
plane { z, 0 pigment { checker rgb <0.8, 0.8, 0.75> rgb <0.2, 0.2, 0.25> } finish { Matt } }
sphere {
  0, 0.7
  translate <-2.2, 0, 0.7>
  pigment { rgb 0.2 }
  finish { ambient 0.1 diffuse 0.3 reflection 0.7 }
}
box { -1, 1 scale <0.5, 0.5, 0.6> rotate 30 * z translate <-0.8, 1, 0.6> texture { Blue } }
cone { 0, 0.6, 1.4 * z, 0 translate <0.6, 1.4, 0> texture { Green } }
cylinder { 0, 0.9 * z, 0.45 translate <2.2, 1, 0> texture { Blue } }
torus { 1, 0.4 rotate 90 * x scale 0.6 translate <-0.6, -1, 0.24> texture { Red } }
superellipsoid { <2 / 4, 2 / 2.5> scale 0.6 translate <1.4, -0.8, 0.6> texture { Green } }
