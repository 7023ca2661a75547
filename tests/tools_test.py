"""The checks of tools/ must fail where they should: each is tried on a small made tree."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / 'tools'))

import check_layers  # noqa: E402
import check_rules  # noqa: E402
import check_sizes  # noqa: E402
import cover_camera  # noqa: E402
import measure_loops  # noqa: E402
import measure_map  # noqa: E402
import rearrange_sequence  # noqa: E402


class MadeTree(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write('CMakeLists.txt', 'set(OFM_LAYERS base camera sim\n  tracking)\n')
        self.write('src/ofm/base/ids.h', '#include <string>\n')

    def write(self, path, text):
        path = self.root / path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def problems(self, check):
        with contextlib.redirect_stdout(io.StringIO()):
            return check.check_tree(self.root)

    def assert_one(self, check, *parts):
        problems = self.problems(check)
        self.assertEqual(len(problems), 1, problems)
        for part in parts:
            self.assertIn(part, problems[0])


class Layers(MadeTree):

    def check(self, path, text):
        self.write(path, text)
        return self.problems(check_layers)

    def test_an_include_up_the_list_is_fine(self):
        self.assertEqual(self.check('src/ofm/camera/a.cc', '#include "ofm/base/ids.h"\n'), [])

    def test_an_include_down_the_list_fails(self):
        self.check('src/ofm/camera/a.cc', '\n#include "ofm/tracking/tracker.h"\n')
        self.assert_one(check_layers, 'src/ofm/camera/a.cc:2', 'camera may not use tracking')

    def test_an_include_in_a_comment_is_none(self):
        self.assertEqual(self.check('src/ofm/base/a.h', '// #include "ofm/camera/a.h"\n'), [])

    def test_the_programs_code_is_not_the_librarys(self):
        self.check('src/ofm/base/a.h', '#include "apps/ofm-slam/commands.h"\n')
        self.assert_one(check_layers, 'src/ofm/base/a.h:1')

    def test_an_include_from_beside_fails(self):
        self.check('src/ofm/base/a.h', '#include "ids.h"\n')
        self.assert_one(check_layers, 'src/ofm/base/a.h:1')

    def test_a_module_outside_the_list_fails(self):
        self.check('src/ofm/extra/a.h', '\n')
        self.assert_one(check_layers, 'src/ofm/extra')

    def test_only_tests_may_reach_down_to_the_test_world(self):
        line = '#include "ofm/sim/world.h"\n'
        self.assertEqual(self.check('src/ofm/camera/a_test.cc', line), [])
        self.check('src/ofm/camera/a.cc', line)
        self.assert_one(check_layers, 'src/ofm/camera/a.cc:1')

    def test_a_link_down_the_list_fails(self):
        self.check('src/ofm/camera/CMakeLists.txt', 'ofm_add_module(camera LINKS ofm::tracking)\n')
        self.assert_one(check_layers, 'src/ofm/camera/CMakeLists.txt:1')

    def test_mutexes_outside_base_and_map_fail(self):
        for line in ('std::mutex mutex;', 'std::scoped_lock lock(m);', '#include <mutex>',
                     'const MutexLock lock(mutex_);', 'std::condition_variable_any c;'):
            self.check('src/ofm/camera/a.h', line + '\n')
            self.assert_one(check_layers, 'src/ofm/camera/a.h:1', 'mutexes')
        self.check('src/ofm/camera/a.h', '// std::mutex\n')
        self.assertEqual(self.check('src/ofm/base/mutex.h', 'std::mutex mutex;\n'), [])


class Rules(MadeTree):

    def test_what_a_library_must_not_do_fails(self):
        for line in ('std::cout << 1;', 'exit(1);', 'std::shuffle(a, b, e);', 'printf("x");',
                     'std::uniform_int_distribution<int> d;', 'rand();', 'usleep(5);'):
            self.write('src/ofm/base/a.cc', 'int x;\n' + line + '\n')
            self.assert_one(check_rules, 'src/ofm/base/a.cc:2')

    def test_words_that_only_look_alike_are_fine(self):
        self.write('src/ofm/base/a.cc',
                   'snprintf(b, 9, "x");\noperand();\non_exit(1);\n// std::cout\n')
        self.assertEqual(self.problems(check_rules), [])

    def test_tests_are_free(self):
        self.write('src/ofm/base/a_test.cc', 'sleep_for(x);\n')
        self.assertEqual(self.problems(check_rules), [])


class Sizes(MadeTree):

    def test_a_long_file_fails(self):
        self.write('src/ofm/base/ids_test.cc', 'x\n' * 500)
        self.assertEqual(self.problems(check_sizes), [])
        self.write('src/ofm/base/ids_test.cc', 'x\n' * 501)
        self.assert_one(check_sizes, 'src/ofm/base/ids_test.cc: 501 lines')

    def test_too_few_lines_of_test_fail(self):
        self.write('src/ofm/base/a.cc', 'x\n' * 99)  # and one line of ids.h
        self.write('src/ofm/base/a_test.cc', 'x\n' * 60)
        self.assertEqual(self.problems(check_sizes), [])
        self.write('src/ofm/base/a_test.cc', 'x\n' * 59)
        self.assert_one(check_sizes, '0.59')

    def test_the_tests_folder_counts_as_test(self):
        self.write('src/ofm/base/a.cc', 'x\n' * 99)
        self.write('tests/integration/run.cc', 'x\n' * 60)
        self.assertEqual(self.problems(check_sizes), [])


class Rearranging(MadeTree):

    def setUp(self):
        super().setUp()
        times = [10, 11, 12, 13]
        self.write('in/associations.txt', ''.join(f'{t} rgb/{t}.jpg {t}.25 depth/{t}.png\n' for t in times))
        self.write('in/groundtruth.txt', '# x\n' + ''.join(f'{t} {t} 0 0 0 0 0 1\n' for t in times))

    def rearranged(self, *ranges):
        pairs = rearrange_sequence.read_pairs(self.root / 'in')
        parts = rearrange_sequence.rearrange(pairs, ranges)
        rearrange_sequence.write(self.root / 'out', self.root / 'in', parts)
        return [(float(row[0]), row[1], float(row[2]))
                for row in rearrange_sequence.read_table(self.root / 'out/associations.txt')]

    def test_backward_parts_come_later_and_keep_depth_beside_colour(self):
        frames = self.rearranged('1:3', '3:1')
        self.assertEqual([file for _, file, _ in frames],
                         ['rgb/11.jpg', 'rgb/12.jpg', 'rgb/12.jpg', 'rgb/11.jpg'])
        self.assertEqual(frames, sorted(frames))
        self.assertAlmostEqual(frames[0][2] - frames[0][0], 0.25)
        self.assertAlmostEqual(frames[3][2] - frames[3][0], -0.25)

    def test_ground_truth_is_rearranged_alike(self):
        self.rearranged('1:3', '3:1')
        rows = rearrange_sequence.read_table(self.root / 'out/groundtruth.txt')
        self.assertEqual([row[1] for row in rows], ['11', '12', '12', '11'])
        self.assertEqual([float(row[0]) for row in rows], sorted(float(row[0]) for row in rows))


class Loops(unittest.TestCase):

    def test_a_loop_is_held_against_ground_truth(self):
        turned = (0, 0, 2 ** -0.5, 2 ** -0.5)  # a quarter about z
        truth = [(0, ((1, 0, 0), turned)), (5, ((1, 2, 0), turned))]
        loop = {'stamp': '5', 'place_stamp': '0', 'matches': 50, 'landmarks_fused': 40, 'drift_m': 0.1,
                'drift_deg': 1, 'place_from_keyframe': [2, 0, 0, 0, 0, 0, 1]}
        self.assertIn('wrong by 0.000 m, 0.00 deg', measure_loops.loop_line(loop, truth))
        loop['place_from_keyframe'][0] = 1.5
        self.assertIn('wrong by 0.500 m', measure_loops.loop_line(loop, truth))


class MeasureMap(unittest.TestCase):

    def test_without_a_networks_masks_there_are_no_rows_of_them(self):
        cullings = {culling for _, culling, _ in measure_map.configurations(None)}
        self.assertEqual(cullings, {'off', 'true masks'})
        rows = list(measure_map.configurations(pathlib.Path('masks/yolo')))
        self.assertEqual(len(rows), 3 * len(measure_map.SCENARIOS))
        self.assertIn('perception.masks_folder=masks/yolo/desk_walking', rows[2][2])

    def test_rows_are_chosen_by_all_words(self):
        self.assertTrue(measure_map.is_wanted(None, ('desk_box', 'off')))
        self.assertTrue(measure_map.is_wanted(['box', 'off'], ('desk_box', 'off')))
        self.assertFalse(measure_map.is_wanted(['box', 'true'], ('desk_box', 'off')))

    def test_a_row_has_shares_in_per_cent_and_lengths_in_their_units(self):
        summary = {'trajectory': {'ate': {'translation_m': {'rmse': 0.0123}}}}
        figures = {'resolution_m': 0.02, 'actor_voxels': 200, 'actor_voxels_occupied': 1, 'actor_residue_share': 0.005,
                   'surface_share_mapped': 0.951, 'surface_voxels_seen': 80, 'surface_voxels_seen_mapped': 78,
                   'points': 50, 'points_off_surface': 2, 'median_distance_m': 0.0091}
        self.assertEqual(measure_map.row('desk_box', 'off', summary, figures),
                         '| desk_box | off | 2 cm | 1 of 200 (0.50 %) | 95.1 % | 97.5 % | 9.1 | 4.0 % | 1.23 |')


class CoverCamera(MadeTree):

    def setUp(self):
        super().setUp()
        self.grey = cover_camera.black_png((4, 3), 16, 0)
        for name in ('rgb', 'depth'):
            self.write(f'desk/{name}.txt', '# stamp file\n' + ''.join(
                f'{i / 10:.6f} {name}/{i}.png\n' for i in range(10)))
            for i in range(10):
                self.write(f'desk/{name}/{i}.png', '')
                (self.root / f'desk/{name}/{i}.png').write_bytes(self.grey)
        self.write('desk/groundtruth.txt', 'truth\n')

    def covered(self, name):
        return [i for i in range(10) if not (self.root / f'out/{name}/{i}.png').is_symlink()]

    def test_covers_both_images_of_the_frames_in_the_middle(self):
        cover_camera.cover(self.root / 'desk', self.root / 'out', None, 4)
        self.assertEqual(self.covered('rgb'), [3, 4, 5, 6])
        self.assertEqual(self.covered('depth'), [3, 4, 5, 6])
        self.assertEqual((self.root / 'out/groundtruth.txt').read_text(), 'truth\n')
        self.assertEqual((self.root / 'out/depth/4.png').read_bytes(), self.grey)
        self.assertEqual(cover_camera.png_size(self.root / 'out/rgb/4.png'), (4, 3))

    def test_covers_the_frames_that_are_named_again_and_again(self):
        for first in (2, 7):
            cover_camera.cover(self.root / 'desk', self.root / 'out', first, 2)
            self.assertEqual(self.covered('rgb'), [first, first + 1])


if __name__ == '__main__':
    unittest.main()
