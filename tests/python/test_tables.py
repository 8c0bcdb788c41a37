"""test_tables.py - tables as notebooks, pandas and pickle take them: the csv's columns in its order and words, parts, copies."""
import pickle

from common import CASE2, CHAIN, Test, main, np, table

import hbmcheck

AT = {CASE2: [6, 8], CHAIN: [1.9]}


def runs(case):
    model = hbmcheck.Model.from_yaml(case)
    return {"frf": model.frf(at=AT[case]), "transient": model.transient(AT[case]), "compare": model.compare(AT[case])}


class Tables(Test):
    def test_rows_are_those_of_the_csv(self):
        for case in AT:
            for command, found in runs(case).items():
                with self.subTest(case=case, command=command):
                    said = table(command, case, "--at", ",".join(map(str, AT[case])))
                    rows = list(found.rows())
                    self.assertEqual(list(rows[0])[:len(said)], list(said))
                    for name, column in said.items():
                        values = [row[name] for row in rows]
                        if isinstance(values[0], str):
                            self.assertEqual(values, column, name)
                        else:
                            self.same(values, column, name)

    def test_parts(self):
        found = hbmcheck.Model.from_yaml(CASE2).frf(at=[6, 8], contacts=True)
        self.assertEqual(len(found), 4)
        self.assertEqual(found[1:].omega.tolist(), [8, 8, 8])
        self.assertEqual(found[found.omega < 7].omega.tolist(), [6])
        self.assertEqual(found[-1].contact.tolist(), ["linear"])
        self.assertEqual(found[2:2].omega.tolist(), [])
        self.assertIsNone(found[1:].contacts)
        self.assertEqual(len(found.contacts[[0, 2]]), 2)
        with self.assertRaises(IndexError):
            found[4]

    def test_pickles(self):
        model = pickle.loads(pickle.dumps(hbmcheck.Model.from_yaml(CASE2, set={"hbm.harmonics": 3})))
        curve = model.frf(contacts=True)
        for found in (curve, *runs(CASE2).values()):
            again = pickle.loads(pickle.dumps(found))
            self.assertEqual(list(again.columns), list(found.columns))
            for name, column in found.columns.items():
                np.testing.assert_array_equal(again[name], column)
        again = pickle.loads(pickle.dumps(curve))
        self.assertEqual(len(again.at(8)), len(curve.at(8)))
        np.testing.assert_array_equal(again.contacts.work, curve.contacts.work)
        self.assertEqual(pickle.loads(pickle.dumps(hbmcheck.Model(1, 0.4, 40, forcing=1, sweep=(1, 9)))).frf(at=2).amplitude,
                         hbmcheck.Model(1, 0.4, 40, forcing=1, sweep=(1, 9)).frf(at=2).amplitude)

    def test_a_notebook_shows_it(self):
        found = hbmcheck.Model.from_yaml(CHAIN).compare(1.9)
        shown = found._repr_html_()
        self.assertIn(">verdict</th>", shown)
        self.assertEqual(shown.count("<tr>"), 1 + len(found))
        long = hbmcheck.Model.from_yaml(CASE2).frf()
        self.assertIn(f"{len(long) - 60} more rows", long._repr_html_())

    def test_pandas_takes_rows(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas here")
        frame = pandas.DataFrame(hbmcheck.Model.from_yaml(CHAIN).frf(at=1.9).rows())
        self.assertEqual(frame["response"].tolist(), ["1", "2", "3"])
        self.assertEqual(set(frame["stable"]), {"yes"})


class Columns(Test):
    def test_they_say_what_they_are(self):
        found = hbmcheck.Model.from_yaml(CASE2).transient(6)
        self.assertEqual(found.units["amplitude"], "length")
        self.assertIn("(max - min)/2", found.meanings["amplitude"])
        self.assertEqual({name for name, meaning in found.meanings.items() if not meaning}, set())

    def test_remarks_and_notes(self):
        model = hbmcheck.Model.from_yaml(CASE2)
        found = model.frf(at=2.5)
        self.assertIn("outside the sweep", found.remarks[0])
        self.assertIn("H = 10, exact forces", found.notes[0])
        self.assertEqual(list(found.tables), ["Response curve", "Special points", "Curve"])


if __name__ == "__main__":
    main()
