"""What the lab says when it is asked wrongly: what, where, what to do, and a failing exit."""
import unittest

import lab

POINTS = ("--points", "-")


class Messages(unittest.TestCase):
    def refused(self, *arguments, text="0,0\n"):
        done = lab.run(*arguments, text=text)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_an_unknown_surface_lists_the_names(self):
        said = self.refused("sample", "--surface", "bicubik", *POINTS)
        self.assertIn('"bicubik"', said)
        for name in "function not_a_knot natural periodic natural_document biquadratic blended blended_document blended_differenced gauss bspline".split():
            self.assertIn(name, said)

    def test_an_unknown_function_equation_or_integrator_lists_the_names(self):
        start = ("trajectory", "--surface", "function")
        self.assertIn("parabolic_pot wavy_pot volcano hills", self.refused(*start, "--function", "cone"))
        self.assertIn("surface local_plane as_printed", self.refused(*start, "--equations", "plane"))
        self.assertIn("explicit_euler false_euler verlet_q verlet_q4 rk4 nystrom4 dopri5 precise", self.refused(*start, "--integrator", "euler"))

    def test_an_unknown_contact_or_problem_lists_the_names(self):
        self.assertIn("bilateral unilateral", self.refused("trajectory", "--surface", "function", "--contact", "glued"))
        self.assertIn("integrators surfaces kepler orders flight", self.refused("precision", "--only", "planets"))

    def test_flight_and_central_gravity_are_refused_where_nothing_computes_them(self):
        start = ("trajectory", "--surface", "function")
        pull, flight = ("--central-gravity", "1"), ("--contact", "unilateral")
        for equations in ("local_plane", "as_printed"):
            for option in (pull, flight):
                self.assertIn("--equations surface", self.refused(*start, "--equations", equations, *option))
        self.assertIn("parabola", self.refused(*start, *pull, *flight))

    def test_a_bad_csv_line_is_named_by_its_number(self):
        for line in ("0.5", "0.5,", "0.5,abc", "0.5,0.5,0.5", "nan,0", "1e999,0"):
            self.assertIn("standard input:3:", self.refused("sample", "--surface", "function", *POINTS, text=f"x,y\n0,0\n{line}\n0,0\n"), line)

    def test_a_missing_points_file_is_named(self):
        self.assertIn("nowhere.csv", self.refused("sample", "--surface", "function", "--points", "nowhere.csv"))

    def test_states_and_thrusts_that_are_no_lists_are_shown(self):
        start = ("trajectory", "--surface", "function")
        self.assertIn("x,y,vx,vy", self.refused(*start, "--state", "1,2,3"))
        self.assertIn("tx,ty", self.refused(*start, "--thrust", "1;2"))

    def test_the_exact_equations_refuse_a_surface_without_hessian_and_say_what_to_take(self):
        said = self.refused("trajectory", "--surface", "biquadratic")
        self.assertIn("Hessian", said)
        self.assertIn("local_plane", said)

    def test_precise_refuses_a_surface_without_cells(self):
        self.assertIn("nystrom4", self.refused("trajectory", "--surface", "biquadratic", "--equations", "local_plane", "--integrator", "precise"))

    def test_a_grid_that_does_not_wrap_is_no_periodic_surface(self):
        self.assertIn("periodic", self.refused("sample", "--surface", "periodic", "--function", "hills", *POINTS))

    def test_a_missing_subcommand_is_an_error(self):
        self.assertNotEqual(lab.run().returncode, 0)


if __name__ == "__main__":
    unittest.main()
