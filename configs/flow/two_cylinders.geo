// A channel with two cylinders one behind the other, 0.7 m apart; `./fpi mesh two_cylinders` makes two_cylinders.msh.
DefineConstant[ size = 1 ];  // factor of all sizes
SetFactory("OpenCASCADE");
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Rectangle(1) = {0, 0, 0, 2.2, 0.41};
Disk(2) = {0.2, 0.2, 0, 0.05};
Disk(3) = {0.9, 0.2, 0, 0.05};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
first() = Curve In BoundingBox {0.14, 0.14, -1, 0.26, 0.26, 1};
second() = Curve In BoundingBox {0.84, 0.14, -1, 0.96, 0.26, 1};

// Size: fine on the circles, growing with the distance from them.
Field[1] = MathEval;
Field[1].F = Sprintf("%g * min(0.007 + 0.15*min(sqrt((x-0.2)^2 + (y-0.2)^2) - 0.05, sqrt((x-0.9)^2 + (y-0.2)^2) - 0.05), 0.06)", size);
Background Field = 1;
Transfinite Curve {first(), second()} = 1 + 4*Round(Pi*0.1 / (4*0.007*size));  // vertices in front and behind

Physical Surface("fluid") = {4};
Physical Curve("first") = {first()};
Physical Curve("second") = {second()};
Physical Curve("inlet") = Curve In BoundingBox {-0.01, -0.01, -1, 0.01, 0.42, 1};
Physical Curve("outlet") = Curve In BoundingBox {2.19, -0.01, -1, 2.21, 0.42, 1};
Physical Curve("walls") = {Curve In BoundingBox {-0.01, -0.01, -1, 2.21, 0.01, 1},
                           Curve In BoundingBox {-0.01, 0.40, -1, 2.21, 0.42, 1}};
