// bowl.toml for POV-Ray: z is up, coordinates are right-handed.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 5 }
#declare Tall = tan(radians(24 / 2));
camera {
  location <0, -6.2, 4.4>
  sky z
  right -x * image_width / image_height
  angle degrees(2 * atan(Tall * image_width / image_height))
  look_at <0, 0, 0.72>
}
background { rgb <0.3, 0.35, 0.45> }
light_source { <-6, -6, 12> rgb <0.9, 0.86, 0.78> }
plane { z, 0 pigment { rgb <0.7, 0.55, 0.4> } finish { ambient 0.2 diffuse 0.8 } }
difference {
  sphere {
    0, 1
    pigment { rgb <0.4, 0.07, 0.03> }
    finish { ambient 0.2 diffuse 0.8 phong 0.05 phong_size 12 }
  }
  sphere {
    0, 0.88
    pigment { rgb <0.03, 0.16, 0.27> }
    finish { ambient 0.2 diffuse 0.7 phong 0.7 phong_size 80 reflection 0.03 }
  }
  cone { -0.3 * z, 0, 1.4 * z, 1.9 pigment { rgb <0.8, 0.68, 0.4> } finish { ambient 0.2 diffuse 0.8 } }
  translate 0.985 * z
}
