// The post curve of ambient occlusion: ao' = 1 - clamp(b ((1 - ao) + a), 0, 1)^c.

float post_curve(float ao, vec3 abc) { return 1.0 - pow(clamp(abc.y * ((1.0 - ao) + abc.x), 0.0, 1.0), abc.z); }
