// A channel with a step 0.15 m high on the floor from x = 1 m to the outlet; `./fpi mesh step_channel` makes
// step_channel.msh.
DefineConstant[ size = 1 ];  // factor of all sizes
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 0.15, 0};
Point(4) = {2.2, 0.15, 0};
Point(5) = {2.2, 0.41, 0};
Point(6) = {0, 0.41, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

// Size: finest at the corner, where the pressure is singular, and fine at the foot and behind the corner.
Field[1] = Distance;
Field[1].PointsList = {3};
Field[2] = Distance;
Field[2].PointsList = {2};
Field[3] = MathEval;
Field[3].F = Sprintf("%g * min(min(0.0008 + 0.15*F1, 0.01 + 0.15*F2), 0.03)", size);
Background Field = 3;

Physical Surface("fluid") = {1};
Physical Curve("inlet") = {6};
Physical Curve("outlet") = {4};
Physical Curve("step") = {2, 3};
Physical Curve("walls") = {1, 5};
